; 4:3 alarm: Q5000 does not exist: Q0 to Q1999, QL0 to QL499 and QR0 to QR499 are allowed
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 Q5000 = 3
