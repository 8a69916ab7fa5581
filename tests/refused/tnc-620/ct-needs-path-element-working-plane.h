; 6:1 alarm: CT needs a path element in the working plane directly before it
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5
3 L Z-5
4 CT X+9 Y+9
