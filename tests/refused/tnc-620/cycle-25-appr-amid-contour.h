; 25:1 alarm: APPR LT must begin the contour of label 1 (the block with its starting point may stand before it, nothing else)
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
L X+0 Y+0 RL
L X+20
APPR LT X+40 Y+0 LEN8 RL
L X+60
11 LBL 0
12 END PGM A MM
