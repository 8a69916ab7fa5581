; 4:6 alarm: a number must be smaller than 1e+09
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+99999999999
