; 4:1 alarm: BLK FORM 0.1 needs the tool axis (for example BLK FORM 0.1 Z X+0 Y+0 Z-20)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 BLK FORM 0.1 X+0 Y+0 Z-20
