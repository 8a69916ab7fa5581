; 5:6 alarm: LP PR (polar radius) must be at least 0, got -1
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CC X+3 Y+4
3 LP IPR-6 PA+0
