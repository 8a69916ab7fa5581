; 4:20 alarm: APPR LCT R (radius of the arc) must be greater than 0, got -5
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 APPR LCT X+1 Y+2 R-5 RL
