; 4:12 alarm: RL and RR stand in one block: one of R0, RL, RR is allowed
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 RL RR
