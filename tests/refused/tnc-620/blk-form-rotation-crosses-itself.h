; 4:33 alarm: BLK FORM ROTATION: the contour of label 1 is no area: the contour crosses or touches itself near (-6.667, 15.000)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 BLK FORM ROTATION Z DIM_R LBL 1
3 M30
4 LBL 1
5 L X+5 Z+0
6 L X+20 Z-10
7 L X+20 Z+0
8 L X+5 Z-20
9 L Z+0
10 LBL 0
