; 4:7 alarm: Q1 = needs a value
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 Q1 =
