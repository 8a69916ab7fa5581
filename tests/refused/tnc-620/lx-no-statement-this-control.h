; 4:3 alarm: LX is no statement of this control (near: L)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 LX+5 Y
