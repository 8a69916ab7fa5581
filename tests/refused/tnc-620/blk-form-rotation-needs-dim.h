; 4:23 alarm: DIM_R (radii) or DIM_D (diameters) is missing (for example BLK FORM ROTATION Z DIM_R LBL 1)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 BLK FORM ROTATION Z LBL 1
