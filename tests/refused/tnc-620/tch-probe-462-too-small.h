; 7:1 alarm: TCH PROBE 462 Q407 (radius of the ring) must be greater than the radius of the ball, 2, got 2
; 17.8: the ball of radius 2 does not enter
BEGIN PGM A MM
TOOL CALL 6 Z
L X+0 Y+0 Z+20 R0 FMAX
TCH PROBE 462 X
Q407=2
Q320=0
Q423=8
Q380=0
