; 4:5 alarm: X needs a number, found '+'
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X++5
