; 22:1 alarm: CYCL DEF 27: the inside arc of radius 3 is not greater than the distance 5: 2 mm are missing, the largest distance for the whole contour is 3 mm (take a smaller tool)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F200
2 M3
3 CYCL DEF 14.0 CONTOUR
4 CYCL DEF 14.1 CONTOUR LABEL 1
5 CYCL DEF 27 CYLINDER
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
RND R3
L Y+50
9 LBL 0
99 END PGM A MM
