; 7:1 alarm: TCH PROBE 441 Q396 (positioning feed rate) must be at least 0 and at most 99999.9999, got 100000
; 17.10: up to 99999.9999
BEGIN PGM A MM
TOOL CALL 6 Z
L X+0 Y+0 Z+20 R0 FMAX
TCH PROBE 441 X
Q396=100000
Q397=0
Q399=1
Q400=1
