; 4:17 alarm: TOOL CALL F (feed rate) must be greater than 0, got 0
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TOOL CALL 1 Z F0
