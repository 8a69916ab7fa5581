; 5:4 alarm: all sub-blocks of a cycle must be marked with / or none
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 7.0 D
/3 CYCL DEF 7.1 X+5
