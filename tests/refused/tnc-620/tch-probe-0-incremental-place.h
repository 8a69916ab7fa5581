; 5:17 alarm: only X, Y and Z of the pre-position stand here, absolute
0 BEGIN PGM A MM
1 TOOL CALL 6 Z
2 TCH PROBE 0.0 REF. PLANE Q5 X-
3 TCH PROBE 0.1 IX+5 Y+0 Z-5
4 END PGM A MM
