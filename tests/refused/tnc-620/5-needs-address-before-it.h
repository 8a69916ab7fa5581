; 5:8 alarm: '5' needs an address before it (a blank inside a number splits it)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 200 D
Q200=2 5
