; 4:22 alarm: no value was given to Q2
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 4: Q1 = +5 DIV +Q2
