; 5:6 alarm: CP IPA (angle travelled) must not be 0
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CC X+5 Y+5
3 CP IPA+0 DR+
