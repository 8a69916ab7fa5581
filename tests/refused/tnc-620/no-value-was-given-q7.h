; 4:13 alarm: no value was given to Q7
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TOOL CALL Q7 Z
