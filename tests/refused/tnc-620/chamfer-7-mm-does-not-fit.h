; 7:1 alarm: a chamfer of 7 mm does not fit between its elements, which are too short for it
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+9
3 CHF 3
4 L Y+9
5 CHF 7
6 L X+0
