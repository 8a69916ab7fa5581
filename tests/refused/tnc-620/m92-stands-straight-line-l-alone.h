; 4:17 alarm: M92 stands in a straight line L alone
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 C X+1 Y+2 DR+ M92
