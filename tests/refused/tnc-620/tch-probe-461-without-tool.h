; 4:1 alarm: TCH PROBE 461 needs a tool call before it, which names the probe and its axis
; 17.7: a tool call defines the axis
BEGIN PGM A MM
TCH PROBE 461 X
Q434=5
