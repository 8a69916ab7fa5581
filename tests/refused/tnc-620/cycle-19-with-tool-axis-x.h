; 5:1 alarm: CYCL DEF 19 with the tool axis X: not built yet (with the tool axis Z it is)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TOOL CALL 1 X
3 CYCL DEF 19.0 P
4 CYCL DEF 19.1 A+0 B+90 C+0
