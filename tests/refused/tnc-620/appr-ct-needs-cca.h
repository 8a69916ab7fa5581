; 4:1 alarm: APPR CT needs CCA (centre angle of the arc)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 APPR CT X+1 Y+2 R5 RL
