; 4:1 alarm: IF is no statement of this control (a jump is FN 9: IF +Q1 EQU +Q3 GOTO LBL 5)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100 ; a tool
IF Q92 = Q78 GOTO LBL2
