; 7:1 alarm: TCH PROBE 460 Q407 (exact radius of the calibration sphere) must be at least 0.0001 and at most 99.9999, got 0
; 17.6: at least 0.0001
BEGIN PGM A MM
TOOL CALL 6 Z
L X+0 Y+0 Z+20 R0 FMAX
TCH PROBE 460 X
Q407=0
Q320=0
Q301=1
Q423=4
Q380=0
Q433=0
Q434=0
Q455=0
