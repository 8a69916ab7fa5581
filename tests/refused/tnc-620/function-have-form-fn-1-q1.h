; 4:14 alarm: the function must have the form FN 1: Q1 = +2 + +3
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 1: Q1 = +1
