; 6:1 alarm: TCH PROBE 461 Q434 (height of the touched surface) is missing
; 17.7: Q434 is needed
BEGIN PGM A MM
TOOL CALL 6 Z
L X+0 Y+0 Z+20 R0 FMAX
TCH PROBE 461 X
