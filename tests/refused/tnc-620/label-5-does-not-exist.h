; 4:12 alarm: label 5 does not exist (this program has no labels)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CALL LBL 5
