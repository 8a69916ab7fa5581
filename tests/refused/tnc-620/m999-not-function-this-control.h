; 4:9 alarm: M999 is not a function of this control (near: M99)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 M999
