; manner: DIN/ISO, full circle and half circles about I J
; at 12: 30, 0, 5
; at 14: 30, 0, -2
; at 15: -30, 0, -2
; at 16: -20, 0, -2
; at 18: 0, 20, -2
; at 19: 0, 20, 50
%RING G71 *
N10 G30 G17 X-50 Y-50 Z-20 *
N20 G31 G90 X+50 Y+50 Z+0 *
N30 T4 G17 S4000 F400 *
N40 G00 G40 G90 X+30 Y+0 Z+5 M3 *
N50 G01 Z-2 F100 *
N60 I+0 J+0 G02 X+30 Y+0 F400 *
N70 G03 X-30 Y+0 *
N80 G01 X-20 *
N90 I+0 J+0 *
N100 G02 X+0 Y+20 *
N110 G00 Z+50 M2 *
N99999999 %RING G71 *
