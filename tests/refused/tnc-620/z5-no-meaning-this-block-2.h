; 5:6 alarm: Z5 has no meaning in this block (CT does not take Z)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5
3 CT Z+5
