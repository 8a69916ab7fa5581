; 5:1 alarm: a chamfer of 2 mm needs both its elements in the working plane
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+9
3 CHF 2
4 L Z-3
5 L Y+5
