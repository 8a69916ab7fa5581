; 4:16 alarm: BLK FORM 0.1: the tool axis must be X, Y or Z, got W
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 BLK FORM 0.1 W X+0 Y+0 Z-20
