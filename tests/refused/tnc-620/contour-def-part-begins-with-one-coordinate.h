; 6:1 alarm: the contour of label 1 must begin with both coordinates of the plane
0 BEGIN PGM A MM
1 CONTOUR DEF P1 = LBL 1
2 M30
LBL 1
L X+0
L X+40 Y+40
L X+0
LBL 0
9 END PGM A MM
