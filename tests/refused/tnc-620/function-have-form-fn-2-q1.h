; 4:14 alarm: the function must have the form FN 2: Q1 = +2 - +3
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 2: Q1 = 3 - 4 - 5
