; 4:17 alarm: M120 LA needs a number (for example M120 LA5)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 RL M120 LA
