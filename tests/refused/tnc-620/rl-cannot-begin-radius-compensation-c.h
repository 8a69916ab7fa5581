; 4:9 alarm: RL cannot begin the radius compensation in C (write it in a straight line L)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 C X+5 RL DR+
