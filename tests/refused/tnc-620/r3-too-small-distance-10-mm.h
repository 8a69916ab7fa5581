; 4:11 alarm: R3 is too small for the distance 10 mm between start and end: at least 5 mm is needed (too short by 2 mm)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CR X+10 R+3 DR+
