; manner: DIN/ISO: datum shift G54, mirror G28, rotation G73, scaling G72
; G54 to (50, 50); turned by 90 degrees the point (30, 0) is (0, 30)
; at 14: 80, 50, 10
; at 16: 40, 80, 10
; at 19: 20, 50, 10
; at 22: 65, 60, 10
; at 25: 0, 0, 10
%VERSCHIEBEN G71 *
N10 G30 G17 X+0 Y+0 Z-20 *
N20 G31 G90 X+100 Y+100 Z+0 *
N30 T4 G17 S3000 F300 *
N40 G00 G40 G90 Z+10 M3 *
N50 G54 X+50 Y+50 *
N60 X+30 Y+0 *
N70 G73 G90 H+90 *
N80 X+30 Y+10 *
N90 G73 G90 H+0 *
N100 G28 X *
N110 X+30 Y+0 *
N120 G28 *
N130 G72 F0.5 *
N140 X+30 Y+20 *
N150 G72 F1 *
N160 G54 X+0 Y+0 *
N170 X+0 Y+0 *
N180 Z+50 M2 *
N99999999 %VERSCHIEBEN G71 *
