; 5:7 alarm: CHF (chamfer side length) must be greater than 0, got 0
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5
3 CHF 0
