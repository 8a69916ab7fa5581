; 6:1 alarm: the inside arc of radius 4 is not greater than the tool radius 5: 1 mm is missing, the largest radius for the whole contour is 4 mm (take a smaller tool)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+9 RL
3 L X+20
4 CR X+20 Y+8 R4 DR+
