; 5:1 alarm: a chamfer of 2 mm needs a path element after it
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5
3 CHF 2
