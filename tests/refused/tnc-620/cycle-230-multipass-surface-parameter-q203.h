; 16:1 alarm: Q203=0 has no meaning in this block (CYCL DEF 230 does not take Q203) (a line Q… without a block number belongs to the definition above it: number it to assign a variable)
BEGIN PGM A MM
TOOL CALL 1 Z S1000
L X+20 Y+10 Z+2 R0 FMAX M3
CYCL DEF 230 X
Q225=10
Q226=12
Q227=0
Q218=150
Q219=75
Q240=10
Q206=150
Q207=500
Q209=200
Q200=2
Q203=0
CYCL CALL
END PGM A MM
