; 4:11 alarm: FSELECT must follow a block of a free contour
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FSELECT 1
