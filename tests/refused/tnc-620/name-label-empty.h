; 4:7 alarm: the name of a label is empty
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 LBL ""
