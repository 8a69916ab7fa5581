; 4:15 alarm: FN 13: two sides of length 0 have no angle
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 13: Q1 = +0 ANG +0
