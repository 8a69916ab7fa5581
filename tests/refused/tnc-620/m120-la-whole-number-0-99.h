; 4:17 alarm: M120 LA (blocks looked at in advance) must be a whole number from 0 to 99, got 100
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 RL M120 LA100
