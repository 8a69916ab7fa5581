; 4:28 alarm: TCH PROBE 0 Q (Q parameter of the result) must be a whole number and at least 0 and at most 1999, got 2000
0 BEGIN PGM A MM
1 TOOL CALL 6 Z
2 TCH PROBE 0.0 REF. PLANE Q2000 X-
3 TCH PROBE 0.1 X+5 Y+0 Z-5
4 END PGM A MM
