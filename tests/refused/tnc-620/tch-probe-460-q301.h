; 9:1 alarm: TCH PROBE 460 Q301 (height between measuring points) must be one of 0, 1, got 2
; 17.6: Q301 is 0 or 1
BEGIN PGM A MM
TOOL CALL 6 Z
L X+0 Y+0 Z+20 R0 FMAX
TCH PROBE 460 X
Q407=12.5
Q320=0
Q301=2
Q423=4
Q380=0
Q433=0
Q434=0
Q455=0
