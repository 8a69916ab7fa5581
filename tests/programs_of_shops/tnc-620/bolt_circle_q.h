; manner: vendor's training, bolt circle computed in Q-parameters, holes by L with M99
; five holes, 72 degrees apart, on radius 30 about (50, 40), from 18 degrees
; at 17: 50+30*cos(18), 40+30*sin(18), 5 | 50, 70, 5 | 50+30*cos(162), 40+30*sin(162), 5 | 50+30*cos(234), 40+30*sin(234), 5 | 50+30*cos(306), 40+30*sin(306), 5
0 BEGIN PGM TEILKREIS MM
1 BLK FORM 0.1 Z X+0 Y+0 Z-20
2 BLK FORM 0.2 X+100 Y+80 Z+0
3 Q10 = 5 ; ANZAHL
4 Q11 = 18 ; STARTWINKEL
5 Q12 = 30 ; RADIUS
6 Q13 = 360 / Q10
7 Q14 = 0
8 TOOL CALL 2 Z S1000 F100
9 L Z+50 R0 FMAX M3
10 CYCL DEF 200 BOHREN Q200=2 Q201=-6 Q206=100 Q202=6 Q210=0 Q203=0 Q204=5 Q211=0
11 CC X+50 Y+40
12 LBL 1
13 LP PR+Q12 PA+Q11 R0 FMAX M99
14 Q11 = Q11 + Q13
15 Q14 = Q14 + 1
16 FN 12: IF +Q14 LT +Q10 GOTO LBL 1
17 L Z+50 R0 FMAX M30
18 END PGM TEILKREIS MM
