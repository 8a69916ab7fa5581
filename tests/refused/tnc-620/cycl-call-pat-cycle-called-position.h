; 15:1 alarm: CYCL CALL PAT: a cycle is called at a position without radius compensation (write R0 in the block before)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 200 D
Q200=2
Q201=-15
Q206=250
Q202=0
Q210=0
Q203=0
Q204=20
Q211=0
3 L X+50 RL F100 M3
4 PATTERN DEF POS1 (X+10 Y+10 Z+0) POS2 (X+30 Y+10 Z+0)
5 CYCL CALL PAT
