; 4:15 alarm: MB50 and MBMAX stand in one block: one distance is allowed
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L M140 MB50 MB MAX
