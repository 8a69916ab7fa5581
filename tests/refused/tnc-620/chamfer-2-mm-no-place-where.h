; 5:1 alarm: a chamfer of 2 mm has no place where the path runs straight back
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+9
3 CHF 2
4 L X+2
