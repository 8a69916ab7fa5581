; 4:14 alarm: M91 stands in a straight line L alone
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CC X+1 Y+1 M91
