; 4:13 alarm: M94 names an axis without a number, got C5
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 M94 C5
