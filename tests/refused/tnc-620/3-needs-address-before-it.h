; 4:9 alarm: '3' needs an address before it (a blank inside a number splits it)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 3
