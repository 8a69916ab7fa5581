; 4:11 alarm: FN 0 needs a Q parameter and = (FN 0: Q1 = +2)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 0: Q1
