; 3:15 alarm: CONTOUR DEF I1: the first part must be a pocket, the deepest one
0 BEGIN PGM A MM
1 CONTOUR DEF I1 = LBL 1 P2 = LBL 1
2 M30
LBL 1
L X+0 Y+0
L X+40
L Y+40
L X+0
L Y+0
LBL 0
9 END PGM A MM
