; 4:3 alarm: TOOLCALL is no statement of this control (near: TOOL CALL)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TOOLCALL 1 Z S1000
