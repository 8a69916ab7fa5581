; 4:8 alarm: ASIN of 2 has no real value
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 Q1 = ASIN 2
