; 4:9 alarm: M138 is refused: choice of tilting axes, not built yet: write the angles of the rotary axes in a block L
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 M138 A C
