; 4:15 alarm: TOOL CALL: the tool axis X is not built yet, Z is
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TOOL CALL 1 X
