; 4:9 alarm: a text in quotes or a QS parameter was expected, found '5'
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 QS1 = 5
