; 4:12 alarm: a number or a Q parameter was expected (for example FN 9: IF +Q1 EQU +Q3 GOTO LBL 5)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 9: IF EQU +3 GOTO LBL 5
