; 9:1 alarm: the contour of label 1 leaves the plane XY
0 BEGIN PGM A MM
1 CONTOUR DEF P1 = LBL 1
2 M30
LBL 1
L X+0 Y+0
L X+40
CC X+30 Z+0
C X+30 Z+10 DR-
L X+0
LBL 0
9 END PGM A MM
