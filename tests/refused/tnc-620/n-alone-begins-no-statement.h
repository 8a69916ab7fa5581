; 4:1 alarm: N begins no statement (a straight line begins with L)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
N L X+5
