; 5:1 alarm: a rounding of R5 does not fit between its elements, which are too short for it
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+4
3 RND R5
4 L Y+4
