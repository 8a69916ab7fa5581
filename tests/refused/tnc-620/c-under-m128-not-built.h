; 5:5 alarm: C under M128 (tool centre point management) is not built yet
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 F9 M128 F500
3 L C+5
