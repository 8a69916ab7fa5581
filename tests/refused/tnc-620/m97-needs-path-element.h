; 4:3 alarm: M97 stands in the block of a path element
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 M97
