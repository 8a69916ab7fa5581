; 4:7 alarm: a label must be a number from 0 to 65535, got 70000
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 LBL 70000
