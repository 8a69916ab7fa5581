; manner: a TNC 150: every block has its R, F and M, and what is empty stays as it is
; a step, then the same mirrored about X 0
; at 12: 0, 9.5, 2 | 0, 9.5, 2
; at 13: 0, 9.5, -4 | 0, 9.5, -4
; at 14: 12.5, 9.5, -4 | -12.5, 9.5, -4
; at 15: 12.5, 6.5, -4 | -12.5, 6.5, -4
; at 16: 12.5, 6.5, 2 | -12.5, 6.5, 2
0 BEGIN PGM 700 MM
1 TOOL DEF 1 L+0,000 R+2,000 F300
2 TOOL CALL 1 Z S 5000,000
3 LBL 1
4 L X+0,000 Y+9,500 Z+2,000 R F5000 M13
5 L Z-4,000 R F100 M
6 L X+12,500 R F M
7 L Y+6,500 R F M
8 L Z+2,000 R F3000 M
9 LBL 0
10 CYCL DEF 8.0 MIRROR IMAGE
11 CYCL DEF 8.1 X
12 CALL LBL 1 REP
13 CYCL DEF 8.0 MIRROR IMAGE
14 CYCL DEF 8.1
15 END PGM 700 MM
