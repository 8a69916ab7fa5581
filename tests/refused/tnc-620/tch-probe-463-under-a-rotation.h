; 8:1 alarm: TCH PROBE 463 cannot run while a rotation is active
; 17.1: no transformation may be active
BEGIN PGM A MM
TOOL CALL 6 Z
L X+0 Y+0 Z+20 R0 FMAX
CYCL DEF 10.0 R
CYCL DEF 10.1 ROT+5
TCH PROBE 463 X
Q407=10
Q320=0
Q301=1
Q423=8
Q380=0
