; 4:28 alarm: APPR CT needs RL or RR: without a side it has no direction
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 APPR CT X+1 Y+2 CCA90 R5 R0
