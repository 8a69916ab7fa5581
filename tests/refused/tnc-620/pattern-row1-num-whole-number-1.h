; 4:33 alarm: PATTERN DEF ROW1 NUM (number of positions) must be a whole number from 1 to 100000, got 0
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 PATTERN DEF ROW1 (X+5 Y+0 D+3 NUM0 ROT+0 Z+0)
99 END PGM A MM
