; 4:17 alarm: TOOL CALL S (spindle speed) must be at least 0, got -5
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TOOL CALL 1 Z S-5
