; 4:27 alarm: APPR LT runs at feed: FMAX is for straight lines
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 APPR LT X+1 Y+2 LEN5 RL FMAX
