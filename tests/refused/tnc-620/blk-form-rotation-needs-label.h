; 4:29 alarm: LBL, the label of the contour, is missing (for example BLK FORM ROTATION Z DIM_R LBL 1)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 BLK FORM ROTATION Z DIM_R 1
