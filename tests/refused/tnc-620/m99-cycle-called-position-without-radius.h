; 14:13 alarm: M99: a cycle is called at a position without radius compensation (write R0 in the block before)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 200 D
Q200=2
Q201=-15
Q206=250
Q202=5
Q210=0
Q203=0
Q204=20
Q211=0
3 L X+9 RL
4 L X+10 M3 M99
