; 4:13 alarm: no value was given to Q1
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 9: IF +Q1 EQU +3 GOTO LBL 1
3 LBL 1
