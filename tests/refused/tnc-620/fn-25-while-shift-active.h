; 6:19 alarm: FN 25 cannot set the datum while a shift is active
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 7.0 X
3 CYCL DEF 7.1 X+5
4 FN 25: PRESET = X/+100/+0
