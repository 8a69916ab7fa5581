; 4:33 alarm: FN 18: SYSREAD ID210 NR4 IDX9 (active scaling factor) is not built yet for this index
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 18: SYSREAD Q1 = ID210 NR4 IDX9
