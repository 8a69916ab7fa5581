; 4:7 alarm: a label must be a whole number or a name in quotes (for example LBL 1 or LBL "HOLES")
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 LBL QS1
