; 4:10 alarm: an operator was expected before MOD
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 Q1 = 2 MOD 3
