; 4:3 alarm: Q108 (radius of the active tool with its deltas) is kept by the control and cannot be assigned (take another parameter)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 Q108 = 3
