; 5:16 alarm: RR cannot begin the radius compensation in CP (write it in a straight line L)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CC X+5 Y+5
3 CP PA+30 DR+ RR
