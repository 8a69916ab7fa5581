; 12:1 alarm: TCH PROBE 460 Q433 (calibrating the length too) must be one of 0, 1, got -1
; 17.6: Q433 is 0 or 1
BEGIN PGM A MM
TOOL CALL 6 Z
L X+0 Y+0 Z+20 R0 FMAX
TCH PROBE 460 X
Q407=12.5
Q320=0
Q301=1
Q423=4
Q380=0
Q433=-1
Q434=0
Q455=0
