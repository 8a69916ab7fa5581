; 4:19 alarm: APPR LN LEN (length of the line) must be greater than 0, got -5
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 APPR LN X+1 Y+2 LEN-5 RL
