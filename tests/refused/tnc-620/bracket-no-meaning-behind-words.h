; 4:9 alarm: '(' has no meaning here (a comment begins with ;)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 (up)
