; 6:9 alarm: M130 in a tilted plane is not built yet
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 19.0 X
3 CYCL DEF 19.1 A+30
4 L X+5 M130
