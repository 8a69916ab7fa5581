; 7:1 alarm: TCH PROBE 463 Q407 (radius of the stud) must be at least 0 and at most 99.9999, got 100
; 17.9: up to 99.9999
BEGIN PGM A MM
TOOL CALL 6 Z
L X+0 Y+0 Z+20 R0 FMAX
TCH PROBE 463 X
Q407=100
Q320=0
Q301=1
Q423=8
Q380=0
