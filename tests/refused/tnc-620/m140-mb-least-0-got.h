; 4:17 alarm: M140 MB (distance of the retraction) must be at least 0, got -50
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 F9 M140 MB-50
