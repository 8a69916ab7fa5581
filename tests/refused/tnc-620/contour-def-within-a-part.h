; 6:13 alarm: CONTOUR DEF cannot stand in the description of a contour
0 BEGIN PGM A MM
1 CONTOUR DEF P1 = LBL 1
2 M30
LBL 1
CONTOUR DEF P1 = LBL 2
L X+0 Y+0
L X+40
L Y+40
L X+0
L Y+0
LBL 0
LBL 2
L X+0 Y+0
L X+40
L Y+40
L X+0
L Y+0
LBL 0
9 END PGM A MM
