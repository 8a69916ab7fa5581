; 4:17 alarm: FMAX has no meaning in this block (TOOL CALL does not take FMAX)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TOOL CALL 1 Z FMAX
