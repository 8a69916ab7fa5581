; 5:1 alarm: an open corner is not built where the compensated contour goes on behind it at an angle (no manual says how the tool goes from one element to the next; write R0 in the block after it)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 RL
3 L X+50 M98
4 L Y+30
