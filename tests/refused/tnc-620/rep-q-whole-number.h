; 7:14 alarm: CALL LBL REP (repeats) must be a whole number from 0 to 999999999, got 2.5
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 Q1 = 2.5
3 LBL 1
4 L IX+3 FMAX
5 CALL LBL 1 REPQ1
