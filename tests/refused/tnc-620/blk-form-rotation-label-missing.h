; 4:33 alarm: label 7 does not exist (this program has no labels)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 BLK FORM ROTATION Z DIM_R LBL 7
