; 4:1 alarm: FLT needs a path element in the working plane directly before it
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FLT X+25
