; manner: German school, a hexagon in polar coordinates
; at 15: 90, 50, 50
; at 17: 50+40*cos(60), 50+40*sin(60), -3
; at 18: 50+40*cos(120), 50+40*sin(120), -3
; at 19: 10, 50, -3
; at 20: 50+40*cos(240), 50+40*sin(240), -3
; at 21: 50+40*cos(300), 50+40*sin(300), -3
; at 22: 90, 50, -3
0 BEGIN PGM SECHSECK MM
1 BLK FORM 0.1 Z X+0 Y+0 Z-15
2 BLK FORM 0.2 X+100 Y+100 Z+0
3 TOOL CALL 1 Z S2000 F300
4 CC X+50 Y+50
5 L Z+50 R0 FMAX M3
6 LP PR+40 PA+0 R0 FMAX
7 L Z-3 F100
8 LP PR+40 PA+60 F300
9 LP IPA+60
10 LP IPA+60
11 LP PA+240
12 LP PA-60
13 LP PA+0
14 L Z+50 R0 FMAX M30
15 END PGM SECHSECK MM
