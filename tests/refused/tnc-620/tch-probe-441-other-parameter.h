; 11:1 alarm: Q320=5 has no meaning in this block (TCH PROBE 441 does not take Q320) (a line Q… without a block number belongs to the definition above it: number it to assign a variable)
; 17.10: it has no Q320
BEGIN PGM A MM
TOOL CALL 6 Z
L X+0 Y+0 Z+20 R0 FMAX
TCH PROBE 441 X
Q396=3000
Q397=0
Q399=1
Q400=1
Q320=5
