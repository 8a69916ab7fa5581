; 4:32 alarm: BLK FORM CYLINDER: the bore must be smaller than the cylinder, radius 60 in 50
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 BLK FORM CYLINDER Z R50 L100 DI120
