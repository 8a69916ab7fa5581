; 4:1 alarm: an approach or a departure needs a move: the tool stands at its end already
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 APPR LT X+0 Y+0 LEN5 RL
3 L X+5
