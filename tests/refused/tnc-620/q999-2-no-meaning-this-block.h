; 13:1 alarm: Q999=2 has no meaning in this block (CYCL DEF 200 does not take Q999) (a line Q… without a block number belongs to the definition above it: number it to assign a variable)
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
Q999=2
