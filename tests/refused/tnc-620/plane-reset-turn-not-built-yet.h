; 5:15 alarm: PLANE RESET TURN is not built yet where rotary axes have turned (PLANE RESET STAY is)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L C+5 F9
3 PLANE RESET TURN FMAX
