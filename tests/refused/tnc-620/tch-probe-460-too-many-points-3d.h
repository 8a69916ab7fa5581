; 14:1 alarm: TCH PROBE 460 Q455 (touch points from pole to equator) must be a whole number and at least 0 and at most 30, got 31
; 17.6: at most 30
BEGIN PGM A MM
TOOL CALL 6 Z
L X+0 Y+0 Z+20 R0 FMAX
TCH PROBE 460 X
Q407=12.5
Q320=0
Q301=1
Q423=4
Q380=0
Q433=0
Q434=0
Q455=31
