; 4:1 alarm: CT needs a path element directly before it (whose end gives the direction)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CT X+5 Y+5
