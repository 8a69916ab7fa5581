; manner: vendor's training, a dome of circles by Q-parameters, LBL loop with FN 11
; radius 40: at the angle a of the meridian R cos a and R sin a - 40, a = 0, 30, 60, 90
; at 18: 40, 0, 10 | 40*cos(30), 0, -40 | 20, 0, -20 | 0, 0, 40*sin(60)-40
; at 19: 40, 0, -40 | 40*cos(30), 0, -20 | 20, 0, 40*sin(60)-40 | 0, 0, 0
; at 25: 0, 0, 50
0 BEGIN PGM KUGEL MM
1 Q1 = 0 ; WINKEL
2 Q2 = 30 ; SCHRITT
3 Q3 = 40 ; KUGELRADIUS
4 BLK FORM 0.1 Z X-50 Y-50 Z-50
5 BLK FORM 0.2 X+50 Y+50 Z+0
6 TOOL CALL 4 Z S5000 F800
7 L Z+10 R0 FMAX M3
8 CC X+0 Y+0
9 LBL 1
10 Q4 = Q3 * COS Q1
11 Q5 = Q3 * SIN Q1 - Q3
12 LP PR+Q4 PA+0 R0 F800
13 L Z+Q5
14 FN 11: IF +Q1 GT +89 GOTO LBL 2
15 CP IPA+360 DR+
16 Q1 = Q1 + Q2
17 FN 9: IF +0 EQU +0 GOTO LBL 1
18 LBL 2
19 L Z+50 R0 FMAX M30
20 END PGM KUGEL MM
