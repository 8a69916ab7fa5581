; 8:1 alarm: TCH PROBE 441 Q397 (pre-positioning) must be one of 0, 1, got 2
; 17.10: Q397 is 0 or 1
BEGIN PGM A MM
TOOL CALL 6 Z
L X+0 Y+0 Z+20 R0 FMAX
TCH PROBE 441 X
Q396=3000
Q397=2
Q399=1
Q400=1
