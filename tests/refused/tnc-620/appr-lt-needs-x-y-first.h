; 4:1 alarm: APPR LT needs X and Y of the first contour point
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 APPR LT Y+2 LEN5 RL
