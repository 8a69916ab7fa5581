; 5:18 alarm: a number is missing: the probing angle
0 BEGIN PGM A MM
1 TOOL CALL 6 Z
2 TCH PROBE 1.0 POLAR PRESET
3 TCH PROBE 1.1 X
4 TCH PROBE 1.2 X+5 Y+0 Z-5
5 END PGM A MM
