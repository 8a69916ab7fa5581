; 4:9 alarm: X needs a number
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 LBL 1 X
