; 3:35 alarm: label "HOLE" does not exist (labels of this program: 1)
0 BEGIN PGM A MM
1 CONTOUR DEF P1 = LBL 1 I2 = LBL "HOLE"
2 M30
LBL 1
L X+0 Y+0
L X+40
L Y+40
L X+0
L Y+0
LBL 0
9 END PGM A MM
