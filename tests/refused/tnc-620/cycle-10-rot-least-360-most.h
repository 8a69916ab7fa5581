; 5:17 alarm: CYCL DEF 10 ROT (rotation angle) must be at least -360 and at most 360, got 400
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 10.0 R
3 CYCL DEF 10.1 ROT+400
