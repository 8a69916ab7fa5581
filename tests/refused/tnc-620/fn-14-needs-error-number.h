; 4:10 alarm: FN 14 needs ERROR = and a number (for example FN 14: ERROR = 1000)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 14: 1000
