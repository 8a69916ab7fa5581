; 4:19 alarm: FN 17: SYSWRITE ID50 NR15 IDX1: the teeth of a tool must be a whole number, got 2.5
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 17: SYSWRITE ID50 NR15 IDX1 = +2.5
