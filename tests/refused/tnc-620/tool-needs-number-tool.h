; 4:1 alarm: TOOL DEF needs the number of the tool (for example TOOL DEF 5 L+100 R+4)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TOOL DEF
