; 4:17 alarm: TOOL CALL DR2 (delta corner radius) must be at least 0, got -1: the corner radius is 0
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TOOL CALL 1 Z DR2-1
