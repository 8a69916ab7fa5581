; 25:1 alarm: Q365=0 has no meaning in this block (CYCL DEF 221 does not take Q365) (a line Q… without a block number belongs to the definition above it: number it to assign a variable)
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
4 CYCL DEF 221 L
Q225=15
Q226=25
Q237=10
Q238=8
Q242=6
Q243=4
Q224=15
Q200=2
Q203=30
Q204=50
Q301=1
Q365=0

99 END PGM A MM
