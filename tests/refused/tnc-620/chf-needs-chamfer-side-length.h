; 5:1 alarm: CHF needs the chamfer side length
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5
3 CHF
