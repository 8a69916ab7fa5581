; 4:1 alarm: CYCL DEF 12 PGM (name of the program) is missing
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 12.0 PGM CALL
3 L X+5
