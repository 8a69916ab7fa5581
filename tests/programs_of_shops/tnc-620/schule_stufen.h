; manner: German school, program section repeat with an incremental depth
; at 13: -8, 25, -2 | -8, 25, -4 | -8, 25, -6 | -8, 25, -8
; at 14: 108, 25, -2 | 108, 25, -4 | 108, 25, -6 | 108, 25, -8
; at 17: -8, 25, 100
0 BEGIN PGM NUT MM
1 BLK FORM 0.1 Z X+0 Y+0 Z-20
2 BLK FORM 0.2 X+100 Y+50 Z+0
3 TOOL CALL 1 Z S2000 F300
4 L Z+2 R0 FMAX M3
5 L X-8 Y+25 R0 FMAX
6 L Z+0 F500
7 LBL 1
8 L IZ-2 F100
9 L X+108 F300
10 L X-8 FMAX
11 CALL LBL 1 REP 3/3
12 L Z+100 R0 FMAX M2
13 END PGM NUT MM
