; 4:23 alarm: FN 18: SYSREAD ID10 NR3 (number of the active machining cycle) has no value: no machining cycle is defined
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 18: SYSREAD Q1 = ID10 NR3
