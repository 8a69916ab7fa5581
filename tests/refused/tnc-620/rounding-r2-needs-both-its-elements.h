; 5:1 alarm: a rounding of R2 needs both its elements in the working plane
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+10
3 RND R2
4 L Z-5
5 L Y+10
