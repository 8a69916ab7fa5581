; 4:3 alarm: CYCL is no statement of this control (near: CYCL CALL)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL CAL
