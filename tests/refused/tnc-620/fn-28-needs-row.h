; 4:23 alarm: a number or a Q parameter was expected (for example FN 28: TABREAD Q5 = 5/"X,Y")
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 28: TABREAD Q5 = "X"
