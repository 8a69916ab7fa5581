; 5:1 alarm: LP: the tool stands at the pole, where it has no polar angle (write the angle PA, absolute)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CC
3 LP PR+5
