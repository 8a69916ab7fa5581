; 4:20 alarm: F500 and FMAX stand in one block: one feed is allowed
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L M140 MB50 F500 FMAX
