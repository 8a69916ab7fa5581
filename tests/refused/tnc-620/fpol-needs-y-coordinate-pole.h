; 4:8 alarm: FPOL needs Y, the coordinate of the pole
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FPOL X+10
