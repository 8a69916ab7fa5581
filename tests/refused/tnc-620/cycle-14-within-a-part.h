; 6:1 alarm: CYCL DEF 14 cannot stand in a contour that a cycle reads, nor in a program of contour definitions
0 BEGIN PGM A MM
1 CONTOUR DEF P1 = LBL 1
2 M30
LBL 1
CYCL DEF 14.0 C
CYCL DEF 14.1 LABEL1
L X+0 Y+0
L X+40
L Y+40
L X+0
L Y+0
LBL 0
9 END PGM A MM
