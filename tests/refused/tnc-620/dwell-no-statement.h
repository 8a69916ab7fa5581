; 4:3 alarm: DWELL is no statement of this control (a dwell is FUNCTION DWELL TIME2 or cycle 9)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 DWELL F2.5
