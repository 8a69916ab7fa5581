; 5:14 alarm: REP-2 has no meaning in this block
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 LBL 1
3 CALL LBL 1 REP -2
