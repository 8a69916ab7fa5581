; 4:19 alarm: APPR CT CCA (centre angle of the arc) must be greater than 0 and at most 360, got 400
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 APPR CT X+1 Y+2 CCA400 R5 RL
