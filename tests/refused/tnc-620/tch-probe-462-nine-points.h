; 9:1 alarm: TCH PROBE 462 Q423 (number of touch points) must be a whole number and at least 3 and at most 8, got 9
; 17.8: 3 to 8 points
BEGIN PGM A MM
TOOL CALL 6 Z
L X+0 Y+0 Z+20 R0 FMAX
TCH PROBE 462 X
Q407=25
Q320=0
Q423=9
Q380=0
