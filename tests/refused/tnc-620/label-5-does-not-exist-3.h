; 5:31 alarm: label 5 does not exist (labels of this program: 1)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 LBL 1
3 FN 11: IF +1 GT +0 GOTO LBL 5
