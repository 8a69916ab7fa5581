; 4:7 alarm: no value was given to Q5
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+Q5
