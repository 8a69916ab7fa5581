; 4:1 alarm: CR needs the radius R
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CR X+10 DR+
