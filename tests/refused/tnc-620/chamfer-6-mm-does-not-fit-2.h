; 5:1 alarm: a chamfer of 6 mm does not fit between its elements, which are too short for it
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+9
3 CHF 6
4 L Y+5
