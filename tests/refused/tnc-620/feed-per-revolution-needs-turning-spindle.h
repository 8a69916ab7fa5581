; 4:1 alarm: a feed per revolution needs a turning spindle (write S and M3 before the move)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 FU0.2
