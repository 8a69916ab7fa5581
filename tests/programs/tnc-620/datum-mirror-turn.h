; origin: manual 11.2, 11.5, 11.6 and 11.7 (CYCL DEF 7, 8, 10 and 11): all act about the datum, here shifted to (60, 40)
; (10, 0): (60 + 10, 40) = (70, 40); turned by 90 degrees: (60, 40 + 10) = (60, 50)
; not turned, X mirrored: (10, 5) at (60 - 10, 40 + 5) = (50, 45)
; not mirrored, all by 0.5: (10, 6) at (60 + 5, 40 + 3) = (65, 43)
0 BEGIN PGM DATUMS MM
1 TOOL CALL 1 Z S1000 F200
2 CYCL DEF 7.0 DATUM
3 CYCL DEF 7.1 X+60
4 CYCL DEF 7.2 Y+40
5 L X+10 Y+0 Z+5 R0 FMAX M3
6 CYCL DEF 10.0 ROTATION
7 CYCL DEF 10.1 ROT+90
8 L X+10 Y+0
9 CYCL DEF 10.0 ROTATION
10 CYCL DEF 10.1 ROT+0
11 CYCL DEF 8.0 MIRROR
12 CYCL DEF 8.1 X
13 L X+10 Y+5
14 CYCL DEF 8.0 MIRROR
15 CYCL DEF 8.1
16 CYCL DEF 11.0 SCALING
17 CYCL DEF 11.1 SCL 0.5
18 L X+10 Y+6
19 END PGM DATUMS MM
