; 5:23 alarm: FN 18: SYSREAD ID240 NR1 IDX1 (nominal position in the REF system) has no value: under radius compensation the tool stands beside the programmed point: write R0 before
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 Y+5 RL
3 FN 18: SYSREAD Q1 = ID240 NR1 IDX1
