; 7:1 alarm: DEP LT needs a path element in the working plane directly before it
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+9 RL
3 L X+20
4 L Z+5
5 DEP LT LEN5
