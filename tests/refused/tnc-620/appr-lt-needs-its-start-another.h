; 4:1 alarm: APPR LT needs its start at another place than the contour point
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 APPR LT X+0 Y+0 Z-3 LEN5 RL
3 L X+5
