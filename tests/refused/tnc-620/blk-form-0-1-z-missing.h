; 4:16 alarm: BLK FORM 0.1 Z (coordinate of the corner) is missing
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 BLK FORM 0.1 Z X+0 Y+0
