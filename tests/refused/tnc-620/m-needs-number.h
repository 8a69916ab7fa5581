; 4:5 alarm: M needs a number, found 'X'
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L M X+5
