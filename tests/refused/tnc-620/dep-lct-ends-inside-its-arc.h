; 6:1 alarm: DEP LCT ends inside of its arc of R30: no line touches the arc from there (take a smaller radius, or a point farther away)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+9 RL
3 L X+20
4 DEP LCT X+20 Y+9 R30
