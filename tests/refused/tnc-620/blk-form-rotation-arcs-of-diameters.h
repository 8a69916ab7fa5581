; 4:33 alarm: BLK FORM ROTATION: the contour of label 1 has arcs, which are not built for diameters (DIM_D) (write it with DIM_R)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 BLK FORM ROTATION Z DIM_D LBL 1
3 M30
4 LBL 1
5 L X+0 Z+0
6 L X+20
7 CR X+0 Z-10 R+20 DR+
8 L Z+0
9 LBL 0
