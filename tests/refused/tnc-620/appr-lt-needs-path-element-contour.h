; 4:1 alarm: APPR LT needs a path element of the contour after it
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 APPR LT X+1 Y+2 LEN5 RL
