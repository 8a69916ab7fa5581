; 4:31 alarm: a contour label must be a whole number
0 BEGIN PGM A MM
1 CYCL DEF 14.0 C
2 CYCL DEF 14.1 CONTOUR LABEL "A1"
3 M30
LBL 1
L X+0 Y+0 RL
L X+60
L Y+40
L X+0 Y+0
LBL 0
9 END PGM A MM
