; 5:6 alarm: LP PR (polar radius) must be at least 0, got -5
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CC X+5 Y+5
3 LP PR-5 PA+0
