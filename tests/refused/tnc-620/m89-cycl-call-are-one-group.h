; 14:13 alarm: M89 and CYCL CALL are of one group: only one function of a group may stand in a block
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
3 L Z+50 R0 FMAX M3
4 CYCL CALL M89
