; 5:8 alarm: FPOL X (pole) must be absolute inside a free contour
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FL AN+0
3 FPOL IX+1 Y+0
