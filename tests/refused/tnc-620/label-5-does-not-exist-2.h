; 4:31 alarm: label 5 does not exist (this program has no labels)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 9: IF +1 EQU +3 GOTO LBL 5
