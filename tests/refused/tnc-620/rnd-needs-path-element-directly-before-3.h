; 5:7 alarm: RND needs a path element directly before it
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 APPR LT X+5 Y+0 LEN5 RL
3 RND R2
4 L X+20
