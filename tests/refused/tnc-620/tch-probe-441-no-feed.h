; 7:1 alarm: TCH PROBE 441 Q396 (positioning feed rate) must be greater than 0 where Q397 is 0
; 17.10: at no feed nothing would move
BEGIN PGM A MM
TOOL CALL 6 Z
L X+0 Y+0 Z+20 R0 FMAX
TCH PROBE 441 X
Q396=0
Q397=0
Q399=1
Q400=1
