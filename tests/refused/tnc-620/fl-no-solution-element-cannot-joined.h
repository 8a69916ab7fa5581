; 4:1 alarm: FL has no solution: the element cannot be joined to what is known of the contour
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FL X+10 Y+0 AN+180
