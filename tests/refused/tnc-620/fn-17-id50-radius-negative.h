; 4:19 alarm: FN 17: SYSWRITE ID50 NR2 IDX1: the radius of a tool must be at least 0, got -1
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 17: SYSWRITE ID 50 NR2 IDX1 = -1
