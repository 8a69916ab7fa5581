; 5:1 alarm: FCT needs a path element in the working plane directly before it
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L Z+5
3 FCT R5 DR+
