; 4:1 alarm: FL: the free contour is not determined, 1 more datum is needed; not known here: direction
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FL X+0 Y+0
