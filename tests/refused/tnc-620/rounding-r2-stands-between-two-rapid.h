; 5:1 alarm: a rounding of R2 stands between two rapid moves and needs a feed (write F in its block)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+9 FMAX
3 RND R2
4 L Y+5 FMAX
