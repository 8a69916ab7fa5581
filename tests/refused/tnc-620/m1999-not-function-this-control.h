; 4:9 alarm: M1999 is not a function of this control
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 M1999
