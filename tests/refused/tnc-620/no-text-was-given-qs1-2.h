; 4:11 alarm: no text was given to QS1
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 SEL PGM QS1
