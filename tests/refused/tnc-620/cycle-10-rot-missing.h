; 4:1 alarm: CYCL DEF 10 ROT (rotation angle) is missing
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 10.0 R
