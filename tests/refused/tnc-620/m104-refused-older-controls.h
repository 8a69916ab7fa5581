; 4:9 alarm: M104 is refused: the datum that was set by hand last, a function of older controls that is not built: write CYCL DEF 247
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 M104
