; 4:23 alarm: LEN3 has no meaning in this block (APPR LCT does not take LEN)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 APPR LCT X+1 Y+2 R5 LEN3 RL
