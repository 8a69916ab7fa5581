; 6:1 alarm: APPR LT needs Y and Z of the first contour point
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TOOL CALL 1 X F100
3 L X+0 Y+0 Z+0 FMAX M3
4 APPR LT X+5 Y+5 LEN5 RL
