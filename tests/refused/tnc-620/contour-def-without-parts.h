; 3:1 alarm: CONTOUR DEF needs at least one pocket (for example CONTOUR DEF P1 = "POCKET")
0 BEGIN PGM A MM
1 CONTOUR DEF
2 M30
LBL 1
L X+0 Y+0
L X+40
L Y+40
L X+0
L Y+0
LBL 0
9 END PGM A MM
