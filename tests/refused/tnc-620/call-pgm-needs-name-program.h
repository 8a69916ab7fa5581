; 4:11 alarm: CALL PGM needs the name of a program
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CALL PGM
