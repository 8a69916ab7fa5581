; 3:15 alarm: CONTOUR DEF P2: the first part is P1, the deepest pocket
0 BEGIN PGM A MM
1 CONTOUR DEF P2 = LBL 1 I3 = LBL 1
2 M30
LBL 1
LBL 0
9 END PGM A MM
