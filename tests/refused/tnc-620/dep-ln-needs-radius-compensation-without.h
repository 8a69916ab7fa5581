; 6:1 alarm: DEP LN needs radius compensation: without a side it has no direction
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+9
3 L X+20
4 DEP LN LEN3
