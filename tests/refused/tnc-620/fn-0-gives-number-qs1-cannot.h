; 4:9 alarm: FN 0 gives a number: QS1 cannot hold it (take a Q, QL or QR parameter)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 0: QS1 = 3
