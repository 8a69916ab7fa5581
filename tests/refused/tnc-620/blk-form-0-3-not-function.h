; 4:1 alarm: BLK FORM 0.3 is not a function of this control (near: BLK FORM 0.1, BLK FORM 0.2)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 BLK FORM 0.3 Z X+0
