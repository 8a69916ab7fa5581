; 4:12 alarm: M4 and M3 are of one group: only one function of a group may stand in a block
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 M3 M4
