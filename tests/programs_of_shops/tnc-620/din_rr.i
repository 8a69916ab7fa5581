; manner: DIN/ISO: G42 round a corner, off by a long G40 way
; G42 along Y10 to +X stands at Y5; up along X90 at X95
; at 14: -20, -20, 10
; at 16: 10, 5, -4
; through 17: 90, 5, -4
; through 18: 95, 50, -4
; through 19: 10, 55, -4
; at 20: 5, 10, -4
; at 21: -20, -20, -4
%RECHTS G71 *
N10 G30 G17 X+0 Y+0 Z-20 *
N20 G31 G90 X+100 Y+60 Z+0 *
N30 T1 G17 S2000 F300 *
N40 G00 G40 G90 X-20 Y-20 Z+10 M3 *
N50 G01 Z-4 F500 *
N60 G42 X+10 Y+10 F300 *
N70 X+90 *
N80 Y+50 *
N90 X+10 *
N100 Y+10 *
N110 G00 G40 X-20 Y-20 *
N120 Z+50 M2 *
N99999999 %RECHTS G71 *
