; 4:14 alarm: SQRT of -4 has no real value
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 5: Q1 = SQRT -4
