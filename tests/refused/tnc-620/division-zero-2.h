; 4:16 alarm: division by zero at /
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 Q1 = 2 ^ 0.5 / (1 - 1)
