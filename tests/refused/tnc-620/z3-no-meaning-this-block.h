; 5:16 alarm: Z3 has no meaning in this block (LP does not take Z)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CC X+5 Y+5
3 LP PR+5 PA+0 Z+3
