; 4:3 alarm: QS2000 does not exist: QS0 to QS1999 are allowed
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 QS2000 = "A"
