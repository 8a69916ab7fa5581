; 4:9 alarm: M112 is refused: arcs put in between lines, a function of older controls that is not built: write RND at the corners, or cycle 32
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 M112 T0.01
