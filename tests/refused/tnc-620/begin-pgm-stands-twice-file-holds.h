; 4:3 alarm: BEGIN PGM stands twice: a file holds one program
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 BEGIN PGM B MM
