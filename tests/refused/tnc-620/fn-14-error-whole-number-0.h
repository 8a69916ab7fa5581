; 4:18 alarm: FN 14 ERROR must be a whole number from 0 to 1199, got 1200
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 14: ERROR = 1200
