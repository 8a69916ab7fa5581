; 10:1 alarm: TCH PROBE 460 Q423 (number of touch points) must be a whole number and at least 3 and at most 8, got 2
; 17.6: 3 to 8 points
BEGIN PGM A MM
TOOL CALL 6 Z
L X+0 Y+0 Z+20 R0 FMAX
TCH PROBE 460 X
Q407=12.5
Q320=0
Q301=1
Q423=2
Q380=0
Q433=0
Q434=0
Q455=0
