; 7:1 alarm: C: an arc in ZX cannot stand under radius compensation, which lies in XY (write R0 in a straight line before it)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+10 Y+0 Z+0 RL
3 L X+20
4 CC X+0 Z+0
5 C X+0 Z+20 DR-
