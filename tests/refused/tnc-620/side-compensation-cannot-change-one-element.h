; 6:1 alarm: the side of the compensation cannot change from one element to the next (write a straight line without compensation between them)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+9 RL
3 L X+20
4 L Y+9 RR
5 L Y+30
