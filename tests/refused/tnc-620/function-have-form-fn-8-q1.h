; 4:14 alarm: the function must have the form FN 8: Q1 = +5 LEN +4
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 8: Q1 = +5 + +4
