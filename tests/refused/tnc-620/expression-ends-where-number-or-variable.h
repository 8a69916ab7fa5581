; 4:12 alarm: the expression ends where a number or a variable was expected
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 Q1 = 3 * (
