; 6:1 alarm: CT cannot follow CHF: its direction is that of the element before
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5
3 CHF 2
4 CT X+9 Y+9
