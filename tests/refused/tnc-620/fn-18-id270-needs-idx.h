; 4:29 alarm: FN 18: SYSREAD ID270 NR1 (position in the active coordinate system) needs IDX
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 18: SYSREAD Q1 = ID270 NR1
