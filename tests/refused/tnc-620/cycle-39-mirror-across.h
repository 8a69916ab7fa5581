; 18:1 alarm: CYCL DEF 39 cannot run under a mirror image across the cylinder alone: the axis A must be mirrored, too
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F200
2 M3
2 CYCL DEF 8.0 X
2 CYCL DEF 8.1 Y
3 CYCL DEF 14.0 CONTOUR
4 CYCL DEF 14.1 CONTOUR LABEL 1
5 CYCL DEF 39 CYLINDER
  Q1=-5
  Q3=+0
  Q6=20
  Q10=+5
  Q11=100
  Q12=200
  Q16=+40
  Q17=1
6 L X+0 Y+0 Z+100 R0 FMAX M99
7 M2
8 LBL 1
L X+0 Y+0 RL
L X+50
9 LBL 0
99 END PGM A MM
