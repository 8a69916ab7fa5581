; 4:1 alarm: CYCL DEF 7 needs an axis, for example CYCL DEF 7.1 X+60
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 7.0 S
3 L X+5
