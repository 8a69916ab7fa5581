; manner: post of Edgecam, one contour as a subprogram called at three depths
; at 15: -10, 10, 50
; at 17: -10, 10, -2 | -10, 10, -4 | -10, 10, -6
; at 18: 50, 10, -2 | 50, 10, -4 | 50, 10, -6
; at 21: -10, 10, -2 | -10, 10, -4 | -10, 10, -6
0 BEGIN PGM EDGE1 MM
1 BLK FORM 0.1 Z X0 Y0 Z-10
2 BLK FORM 0.2 X60 Y60 Z0
3 TOOL CALL 3 Z S4000 F600
4 L X-10 Y10 R0 FMAX M3
5 L Z0 FMAX
6 CALL LBL 5
7 CALL LBL 5
8 CALL LBL 5
9 L Z50 R0 FMAX M30
10 LBL 5
11 L IZ-2 F200
12 L X50 F600
13 L Y50
14 L X-10
15 L Y10
16 LBL 0
17 END PGM EDGE1 MM
