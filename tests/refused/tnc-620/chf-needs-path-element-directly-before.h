; 4:7 alarm: CHF needs a path element directly before it
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CHF 2
