; 5:14 alarm: RL cannot begin the radius compensation in CT (write it in a straight line L)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5
3 CT X+9 Y+9 RL
