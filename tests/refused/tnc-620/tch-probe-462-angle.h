; 10:1 alarm: TCH PROBE 462 Q380 (angle of the first touch point) must be at least 0 and at most 360, got -1
; 17.8: 0 to 360 degrees
BEGIN PGM A MM
TOOL CALL 6 Z
L X+0 Y+0 Z+20 R0 FMAX
TCH PROBE 462 X
Q407=25
Q320=0
Q423=8
Q380=-1
