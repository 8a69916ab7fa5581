; 4:31 alarm: FN 12 GOTO LBL 0: LBL 0 is the end of a subprogram and no place to go to
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 12: IF +1 LT +3 GOTO LBL 0
