; 5:19 alarm: TCH PROBE 1 ANGLE (angle from the probing axis) must be at least -180 and at most 180, got 181
0 BEGIN PGM A MM
1 TOOL CALL 6 Z
2 TCH PROBE 1.0 POLAR PRESET
3 TCH PROBE 1.1 X ANGLE: +181
4 TCH PROBE 1.2 X+5 Y+0 Z-5
5 END PGM A MM
