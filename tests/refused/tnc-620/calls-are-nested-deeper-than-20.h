; 5:12 alarm: calls are nested deeper than 20
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 LBL 1
3 CALL LBL 1
