; 6:10 alarm: DEP LT LEN (length of the line) must be greater than 0, got 0
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+9 RL
3 L X+20
4 DEP LT LEN0
