; 4:1 alarm: APPR LT needs RL or RR (the side on which the tool runs beside the contour)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 APPR LT X+1 Y+2 LEN5
