; 4:20 alarm: a number or a Q parameter was expected (for example FN 8: Q1 = +5 LEN +4)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 8: Q1 = +5 LEN
