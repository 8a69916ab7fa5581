; 5:1 alarm: CT needs an end other than its start
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5
3 CT X+5 Y+0
