; 4:14 alarm: TOOL DEF L: the tool table is active, it holds the dimensions of the tools
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TOOL DEF 5 L+10 R+4
