; 4:9 alarm: no text was given to QS2
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 QS1 = QS2
