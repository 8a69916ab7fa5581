; 4:20 alarm: PLANE RESET MB (retraction before the axes turn) is not built yet
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 PLANE RESET TURN MB MAX FMAX
