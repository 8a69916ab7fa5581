; 6:1 alarm: DEP PLT is refused: it names no point that could be polar; write DEP LT
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+9 RL
3 L X+20
4 DEP PLT LEN5
