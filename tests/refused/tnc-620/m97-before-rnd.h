; 6:7 alarm: RND needs a path element directly before it (M97 or M98 stands there)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 RL
3 L X+50 M97
4 RND R3
5 L Y-30
