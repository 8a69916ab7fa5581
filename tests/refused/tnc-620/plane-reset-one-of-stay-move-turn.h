; 4:20 alarm: STAY and TURN stand in one block: one of STAY, MOVE, TURN is allowed
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 PLANE RESET STAY TURN
