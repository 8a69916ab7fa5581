; 4:6 alarm: FL IAN needs a path element in the working plane directly before it
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FL IAN+5 LEN5
