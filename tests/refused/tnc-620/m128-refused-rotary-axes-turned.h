; 5:9 alarm: M128 is not built yet where rotary axes have turned
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L C+5 F9
3 L X+5 M128 F500
