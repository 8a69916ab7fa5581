; 4:1 alarm: TCH PROBE 417 is refused: Preset in the probe axis, not built yet
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TCH PROBE 417 X
Q263=1
