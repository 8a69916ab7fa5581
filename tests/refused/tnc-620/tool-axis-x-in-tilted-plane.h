; 6:15 alarm: TOOL CALL: the tool axis X cannot stand in a tilted working plane (reset cycle 19)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 19.0 P
3 CYCL DEF 19.1 A+0 B+90 C+0
4 TOOL CALL 1 X
