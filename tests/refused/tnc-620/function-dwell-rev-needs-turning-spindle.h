; 4:18 alarm: FUNCTION DWELL REV needs a turning spindle (write S and M3 before the move)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FUNCTION DWELL REV5
