; 5:1 alarm: TCH PROBE 461 needs a touch probe in the spindle, T2 is a drill
; 17.7: it calibrates the touch probe
BEGIN PGM A MM
TOOL CALL 2 Z
TCH PROBE 461 X
Q434=5
