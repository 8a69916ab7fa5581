; 21:1 alarm: Q10=5 has no meaning in this block (CYCL DEF 23 does not take Q10) (a line Q… without a block number belongs to the definition above it: number it to assign a variable)
0 BEGIN PGM A MM
TOOL CALL 1 Z S2000 F500
L X+0 Y+0 Z+100 R0 FMAX M3
CYCL DEF 14.0 CONTOUR
CYCL DEF 14.1 CONTOUR LABEL 1/2
CYCL DEF 20 DATA
Q1=-10
Q2=+1
Q3=+0.5
Q4=+0.2
Q5=+0
Q6=+2
Q7=+50
Q8=+0
Q9=+1
CYCL DEF 23 FLOOR
Q11=+120
Q12=+300
Q208=+8000
Q10=+5
CYCL CALL
L Z+100 R0 FMAX M2
LBL 1
L X+10 Y+20 RR
L Y+80
L X+90
L Y+20
L X+10
LBL 0
LBL 2
CC X+50 Y+50
L X+40 Y+50 RL
C X+40 Y+50 DR-
LBL 0
