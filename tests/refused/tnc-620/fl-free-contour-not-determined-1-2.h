; 5:1 alarm: FL: the free contour is not determined, 1 more datum is needed; not known here: direction, place and end point
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FL X+10 AN+0
3 FL X+50
4 M8
