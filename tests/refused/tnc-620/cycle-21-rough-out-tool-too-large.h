; 21:1 alarm: CYCL DEF 21: the rough-out tool and the allowance for side, 8, do not fit into the contour (take a smaller tool)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L Z+50 R0 FMAX M3
3 CYCL DEF 14.0 C
4 CYCL DEF 14.1 CONTOUR LABEL1
5 CYCL DEF 20 D
Q1=-5
Q2=+1
Q3=+0
Q4=+0
Q5=+0
Q6=+2
Q7=+20
Q8=+0
Q9=+1
6 CYCL DEF 21 P
Q10=+5
Q11=+100
Q13=+5
7 CYCL CALL
8 M30
9 LBL 1
10 L X+0 Y+0 RL
11 L X+60
12 L Y+14
13 L X+0
14 L Y+0
15 LBL 0
16 END PGM A MM
