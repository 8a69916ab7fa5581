; 6:16 alarm: RL has no meaning in this block (DEP LT does not take RL)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 RL F9
3 L X+9
4 DEP LT LEN10 RL
