; 4:15 alarm: TOOL CALL: the tool axis W is not built yet, X, Y and Z are
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TOOL CALL 1 W S5
