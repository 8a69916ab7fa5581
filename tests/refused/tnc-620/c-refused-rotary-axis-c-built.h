; 5:10 alarm: C is refused: the rotary axis C is built for L alone
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5
3 CT X+9 C+5
