; 4:19 alarm: APPR LT LEN (length of the line) must be greater than 0, got 0
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 APPR LT X+1 Y+2 LEN0 RL
