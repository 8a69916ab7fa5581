; 4:1 alarm: DEP LT needs a path element directly before it (whose end gives the direction)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 DEP LT LEN5
