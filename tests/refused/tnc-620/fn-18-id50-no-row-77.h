; 4:23 alarm: FN 18: SYSREAD ID50 NR2 IDX77 (R of a tool) has no value: the tool table has no row 77
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 18: SYSREAD Q1 = ID50 NR2 IDX77
