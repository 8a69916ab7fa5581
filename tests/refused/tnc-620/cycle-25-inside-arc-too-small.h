; 25:1 alarm: the inside arc of radius 4 is not greater than the tool radius 5: 1 mm is missing, the largest radius for the whole contour is 4 mm (take a smaller tool)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S2000 F400
2 L X+0 Y+0 Z+100 R0 FMAX
5 CYCL DEF 14.0 CONTOUR
6 CYCL DEF 14.1 CONTOUR LABEL 1
7 CYCL DEF 25 TRAIN
  Q1=-10
  Q3=0
  Q5=0
  Q7=50
  Q10=5
  Q11=100
  Q12=350
  Q15=1
  Q18=0
  Q446=0.01
  Q447=10
  Q448=2
8 CYCL CALL M3
9 M30
10 LBL 1
CC X+30 Y+30
L X+30 Y+26 RL
C X+30 Y+26 DR+
11 LBL 0
12 END PGM A MM
