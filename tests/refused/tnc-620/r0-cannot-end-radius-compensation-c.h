; 6:13 alarm: R0 cannot end the radius compensation in C (write it in a straight line L)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 RL
3 L X+9
4 C X+9 Y+5 R0 DR+
