; 4:10 alarm: a number has only one decimal point
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+1.2.3
