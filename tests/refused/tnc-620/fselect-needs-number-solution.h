; 5:1 alarm: FSELECT needs the number of a solution
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FL LEN10 AN+0
3 FSELECT
