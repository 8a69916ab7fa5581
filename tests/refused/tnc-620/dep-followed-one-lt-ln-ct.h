; 4:3 alarm: DEP must be followed by one of LT, LN, CT, LCT, PLCT
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 DEP LEN5
