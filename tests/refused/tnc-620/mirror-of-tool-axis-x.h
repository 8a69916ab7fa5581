; 6:16 alarm: CYCL DEF 8 axes (mirrored axes) cannot be the tool axis X
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TOOL CALL 1 X
3 CYCL DEF 8.0 M
4 CYCL DEF 8.1 X
