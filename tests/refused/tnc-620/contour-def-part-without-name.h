; 4:6 alarm: I2 needs the name of a program, or LBL and a label (for example CONTOUR DEF P1 = "POCKET" I2 = "ISLAND" DEPTH5)
0 BEGIN PGM A MM
1 CONTOUR DEF P1 = LBL 1
I2 = DEPTH5
2 M30
LBL 1
L X+0 Y+0
L X+40
L Y+40
L X+0
L Y+0
LBL 0
9 END PGM A MM
