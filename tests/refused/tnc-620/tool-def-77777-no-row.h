; 4:12 alarm: TOOL DEF 77777 has no row in the tool table (tools: 0, 1, 2, 3, 4, 5, 6)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TOOL DEF 77777
