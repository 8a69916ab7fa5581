; 4:6 alarm: Z5 has no meaning in this block (CC does not take Z)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CC Z+5
