; manner: DIN/ISO: tilted plane G80 with A, axes by Q120 Q122
; A90: the tool axis of the plane points to -Y of the part
; at 13: 0, 0, 200
; at 16: 20, -50, -10
; at 17: 20, 8, -10
; at 18: 20, -100, -10
; at 21: 20, -100, 200
; at 22: 0, 0, 200
%SEITE G71 *
N10 G30 G17 X+0 Y+0 Z-40 *
N20 G31 G90 X+80 Y+60 Z+0 *
N30 T2 G17 S1000 *
N40 G00 G40 G90 Z+200 M3 *
N50 G80 A+90 B+0 C+0 *
N60 G00 G40 A+Q120 C+Q122 *
N70 X+20 Y-10 Z+50 *
N80 G01 Z-8 F100 *
N90 G00 Z+100 *
N100 G80 A+0 B+0 C+0 *
N110 G00 A+0 C+0 *
N120 Z+200 *
N130 X+0 Y+0 M2 *
N99999999 %SEITE G71 *
