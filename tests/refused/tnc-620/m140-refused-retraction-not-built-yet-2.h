; 4:12 alarm: M140 is refused: retraction, not built yet
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 F9 M140 MB50 F9
