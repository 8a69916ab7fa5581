; 6:7 alarm: RND needs a path element directly before it
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FL X+5 Y+5
3 RND R1
4 RND R1
5 FL X+9 Y+0
