; 4:12 alarm: M120 is refused: look-ahead, not built yet
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 RL M120 LA5
