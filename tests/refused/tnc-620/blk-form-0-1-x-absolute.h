; 4:18 alarm: BLK FORM 0.1 X (coordinate of the corner) must be absolute
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 BLK FORM 0.1 Z IX+0 Y+0 Z-20
