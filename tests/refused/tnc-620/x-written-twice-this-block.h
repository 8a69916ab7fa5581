; 4:9 alarm: X is written twice in this block (keep one of them)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 X+6
