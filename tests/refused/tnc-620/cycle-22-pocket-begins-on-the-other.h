; 26:1 alarm: the contour of label 1 begins exactly on that of label 2: joined or common area is open (begin it inside the other contour (common area) or outside (joined))
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000
2 CYCL DEF 14.0 C
CYCL DEF 14.1 CONTOUR LABEL 1/2
3 CYCL DEF 20 D
Q1=-5
Q2=+1
Q3=+0
Q4=+0
Q5=+0
Q6=+2
Q7=+20
Q8=+0
Q9=+1
4 CYCL DEF 22 R
Q10=+5
Q11=100
Q12=200
Q18=0
Q19=0
Q208=999
5 CYCL CALL M3
6 M30
LBL 1
L X+0 Y+0 RL
L X+40
L Y+40
L X+0
L Y+0
LBL 0
LBL 2
L X+0 Y-10 RL
L X+20
L Y+20
L X+0
L Y-10
LBL 0
9 END PGM A MM
