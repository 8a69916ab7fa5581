; 4:8 alarm: X5 has no meaning in this block
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 STOP X+5
