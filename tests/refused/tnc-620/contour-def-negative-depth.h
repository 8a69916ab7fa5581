; 3:26 alarm: CONTOUR DEF P1 DEPTH (depth of the contour) must be at least 0, got -5
0 BEGIN PGM A MM
1 CONTOUR DEF P1 = LBL 1 DEPTH-5
2 M30
LBL 1
L X+0 Y+0
L X+40
L Y+40
L X+0
L Y+0
LBL 0
9 END PGM A MM
