; 4:11 alarm: R5 has no meaning in this block (FL does not take R)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FL AN+0 R5
