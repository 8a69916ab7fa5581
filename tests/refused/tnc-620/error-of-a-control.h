; 4:3 alarm: ERROR is no statement of this control (a control writes ERROR = before a block that it could not read: write the block anew, formulas in one of their own)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 ERROR = L XQ102 + Q9
