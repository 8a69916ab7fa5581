; 4:23 alarm: FN 28 needs an open table (FN 26: TABOPEN TAB1.TAB before it)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 28: TABREAD Q5 = 3/"X,Y"
