; 4:33 alarm: BLK FORM ROTATION: the contour of label "RING" must be closed: its end is where it begins
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 BLK FORM ROTATION Z DIM_R LBL "RING"
3 M30
4 LBL "RING"
5 L X+0 Z+0
6 L X+20
7 L Z-10
8 LBL 0
