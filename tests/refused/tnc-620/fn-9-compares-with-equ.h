; 4:15 alarm: FN 9 compares with EQU (for example FN 9: IF +Q1 EQU +Q3 GOTO LBL 5)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 9: IF +1 GT +3 GOTO LBL 5
