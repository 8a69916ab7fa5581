; 4:3 alarm: G has no meaning here (G words belong to DIN/ISO programs; write L, C, CR or CYCL DEF)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 G1 X5
