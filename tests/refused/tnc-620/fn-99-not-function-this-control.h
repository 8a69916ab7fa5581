; 4:1 alarm: FN 99 is not a function of this control (near: FN 9, FN 19, FN 29)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 99: Q1 = 3
