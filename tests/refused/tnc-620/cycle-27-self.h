; 23:1 alarm: CYCL DEF 27: beside this element the tool at the distance 5 goes through another one, which the contour crosses: 5 mm are missing, no tool fits here (end the contour where it meets itself)
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
L Y+50
L X+25
L Y-20
9 LBL 0
99 END PGM A MM
