; 4:15 alarm: M140 F (feed rate of the retraction) must be greater than 0, got 0
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L M140 MB50 F0
