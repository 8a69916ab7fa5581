; 4:12 alarm: TCH PROBE needs the number of a cycle
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TCH PROBE
