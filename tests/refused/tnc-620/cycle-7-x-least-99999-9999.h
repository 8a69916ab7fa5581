; 5:16 alarm: CYCL DEF 7 X (datum shift along X) must be at least -99999.9999 and at most 99999.9999, got 100000
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 7.0 S
3 CYCL DEF 7.1 X+100000
