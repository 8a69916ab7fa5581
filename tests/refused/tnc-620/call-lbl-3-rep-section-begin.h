; 4:12 alarm: CALL LBL 3 REP: the section must begin before this block (REP repeats what stands above)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CALL LBL 3 REP 2
3 LBL 3
