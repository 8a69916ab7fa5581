; 8:1 alarm: TCH PROBE 461 cannot run while a shift is active
; 17.1: no transformation may be active
BEGIN PGM A MM
TOOL CALL 6 Z
L X+0 Y+0 Z+20 R0 FMAX
CYCL DEF 7.0 D
CYCL DEF 7.1 X+5
TCH PROBE 461 X
Q434=5
