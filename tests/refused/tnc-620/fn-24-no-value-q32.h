; 6:22 alarm: FN 24: no value was given to Q32 (4 points stand in 8 parameters)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 Q30 = 1
3 Q31 = 1
4 FN 24: Q20 = CDATA Q30
