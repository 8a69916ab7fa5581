; 4:19 alarm: FN 25: the axis C is not built yet, X, Y and Z are
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 25: PRESET = C/+100/+0
