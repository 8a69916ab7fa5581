; 5:1 alarm: FL: the free contour has 2 solutions here (choose one with FSELECT 1 to FSELECT 2)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FL LEN30
3 FL LEN40 X+50 Y+0
