; 4:22 alarm: 6 parameters from Q1995 on do not exist: the last is Q1999
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 23: Q20 = CDATA Q1995
