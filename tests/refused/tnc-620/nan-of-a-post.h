; 4:5 alarm: X needs a number, found 'n' (what wrote the program could not compute this number and wrote nan)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L Xnan Y+5
