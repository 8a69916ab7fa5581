; 4:21 alarm: X5 has no meaning in this block (TRANS DATUM RESET does not take X)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TRANS DATUM RESET X+5
