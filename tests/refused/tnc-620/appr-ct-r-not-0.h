; 5:25 alarm: APPR CT R (radius of the arc) must not be 0
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 Q1 = 0
3 APPR CT X+1 Y+2 CCA90 R+Q1 RL
