; 5:15 alarm: RX7 must name an earlier block of a free contour, block 7 is none
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FL X+5 Y+1
3 FL IX+5 Y+9 RX 7
