; 5:9 alarm: C under M126 (shortest way of rotary axes) is not built yet
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L M126
3 L X+5 C+5
