; 4:3 alarm: TCH is no statement of this control (near: TCH PROBE)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TCH POBE 417
