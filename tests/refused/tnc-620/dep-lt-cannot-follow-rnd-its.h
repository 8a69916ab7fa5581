; 7:1 alarm: DEP LT cannot follow RND: its direction is that of the element before
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+9 RL
3 L X+20
4 RND R2
5 DEP LT LEN5
