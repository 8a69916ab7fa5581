; 4:12 alarm: CALL LBL 0: LBL 0 is the end of a subprogram and cannot be called
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CALL LBL 0
