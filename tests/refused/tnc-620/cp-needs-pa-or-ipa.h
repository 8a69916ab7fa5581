; 5:1 alarm: CP needs PA (polar angle of the end) or IPA (angle travelled)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CC X+5 Y+5
3 CP DR+
