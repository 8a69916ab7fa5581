; 4:15 alarm: FL LEN12 contradicts what is known of the contour
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FL X+10 Y+0 LEN12
