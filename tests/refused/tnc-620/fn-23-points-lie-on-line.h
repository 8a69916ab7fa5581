; 10:22 alarm: FN 23: the points lie on a line, no circle goes through them
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 Q30 = 1
3 Q31 = 1
4 Q32 = 2
5 Q33 = 2
6 Q34 = 5
7 Q35 = 5
8 FN 23: Q20 = CDATA Q30
