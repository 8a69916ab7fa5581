; 9:1 alarm: Q201=5 has no meaning in this block (GLOBAL DEF 100 does not take Q201) (a line Q… without a block number belongs to the definition above it: number it to assign a variable)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 GLOBAL DEF 100 GENERAL
Q200=3 ;A
Q204=40 ;B
Q253=750 ;C
Q208=1000 ;D
Q201=5
99 END PGM A MM
