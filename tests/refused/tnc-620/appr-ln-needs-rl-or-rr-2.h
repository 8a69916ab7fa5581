; 4:24 alarm: APPR LN needs RL or RR: without a side it has no direction
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 APPR LN X+1 Y+2 LEN5 R0
