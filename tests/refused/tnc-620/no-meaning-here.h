; 4:9 alarm: '/' has no meaning here (a formula stands in a block of its own, for example Q10 = Q1 / 2)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X-Q1/2
