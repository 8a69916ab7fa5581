; 4:14 alarm: the function must have the form FN 6: Q1 = SIN -Q5
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 6: Q1 = SIN(30)
