; 4:17 alarm: division by zero at DIV
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 4: Q1 = +5 DIV +0
