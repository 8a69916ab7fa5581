; 7:1 alarm: the contour of label 1 must begin with both coordinates of the plane
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 BLK FORM ROTATION Z DIM_R LBL 1
3 M30
4 LBL 1
5 L X+5
6 L X+20 Z+0
7 L Z-5
8 L X+5 Z+0
9 LBL 0
