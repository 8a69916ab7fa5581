; 4:11 alarm: CYCL DEF needs the number of a cycle
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF
