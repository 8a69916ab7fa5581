; 5:1 alarm: a rounding of R5 needs a path element after it
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+10
3 RND R5
