; 4:6 alarm: FC R (radius) must be greater than 0, got 0
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FC R0 DR+
