; manner: DIN/ISO, school exercise: every move in G91
; at 13: 0, 0, 2
; at 14: 0, 0, -3
; at 15: 30, 0, -3
; at 16: 50, 20, -3
; at 17: 50, 50, -3
; at 18: 30, 70, -3
; at 19: 0, 0, -3
%KETTE G71 *
N10 G30 G17 X+0 Y+0 Z-20 *
N20 G31 G90 X+100 Y+100 Z+0 *
N30 T1 G17 S1000 F200 *
N40 G00 G40 G90 X+0 Y+0 Z+2 M3 *
N50 G01 G91 Z-5 *
N60 X+30 *
N70 X+20 Y+20 *
N80 Y+30 *
N90 G03 X-20 Y+20 R+20 *
N100 X-30 Y-70 R+100 *
N110 G00 G90 Z+50 M2 *
N99999999 %KETTE G71 *
