; 5:1 alarm: CTP needs a path element directly before it (whose end gives the direction)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CC X+5 Y+5
3 CTP PR+5 PA+0
