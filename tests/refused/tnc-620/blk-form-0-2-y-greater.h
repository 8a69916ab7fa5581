; 5:20 alarm: BLK FORM 0.2 Y (greatest corner) must be greater than 0, got 0
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 BLK FORM 0.1 Z X+0 Y+0 Z-20
3 BLK FORM 0.2 X+9 Y+0 Z+0
