; 6:11 alarm: FSELECT must be the number of a solution, 1 to 2 here, got 3
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FL LEN30
3 FL LEN40 X+50 Y+0
4 FSELECT 3
