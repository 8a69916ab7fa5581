; 6:1 alarm: CT needs a path element in the plane ZX directly before it
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+10 Y+0
3 L Y-5
4 CT X+5 Z+5
