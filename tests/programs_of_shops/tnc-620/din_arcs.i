; manner: DIN/ISO: G02 and G03 with I J and with R, G06 tangential
; G06 goes on from (60, 0) where the arc about (50, 0) left downwards: half a circle to (80, 0)
; at 13: 0, 0, 10
; at 16: 20, 0, -1
; at 17: 40, 0, -1
; at 18: 60, 0, -1
; at 19: 80, 0, -1
; at 20: 80, 30, -1
%BOGEN G71 *
N10 G30 G17 X-20 Y-40 Z-20 *
N20 G31 G90 X+100 Y+40 Z+0 *
N30 T4 G17 S3000 F300 *
N40 G00 G40 G90 X+0 Y+0 Z+10 M3 *
N50 G01 Z-1 F100 *
N60 I+10 J+0 *
N70 G02 X+20 Y+0 F300 *
N80 G03 X+40 Y+0 R+10 *
N90 G02 X+60 Y+0 R+10 *
N100 G06 X+80 Y+0 *
N110 G01 X+80 Y+30 *
N120 G00 Z+50 M2 *
N99999999 %BOGEN G71 *
