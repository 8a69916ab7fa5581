; 11:1 alarm: TCH PROBE 463 Q380 (angle of the first touch point) must be at least 0 and at most 360, got 361
; 17.9: 0 to 360 degrees
BEGIN PGM A MM
TOOL CALL 6 Z
L X+0 Y+0 Z+20 R0 FMAX
TCH PROBE 463 X
Q407=10
Q320=0
Q301=1
Q423=8
Q380=361
