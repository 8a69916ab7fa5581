; 8:1 alarm: TCH PROBE 462 Q320 (set-up clearance) must be at least 0 and at most 99999.9999, got -1
; 17.8: Q320 is 0 or more
BEGIN PGM A MM
TOOL CALL 6 Z
L X+0 Y+0 Z+20 R0 FMAX
TCH PROBE 462 X
Q407=25
Q320=-1
Q423=8
Q380=0
