; 4:1 alarm: CYCL DEF 310 is refused: a cycle of the machine tool builder, whose manual alone describes it: leave it out where it moves nothing
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 310
