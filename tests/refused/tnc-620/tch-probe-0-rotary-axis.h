; 4:31 alarm: the probing axis and its sense stand here: X+, X-, Y+, Y-, Z+ or Z-
0 BEGIN PGM A MM
1 TOOL CALL 6 Z
2 TCH PROBE 0.0 REF. PLANE Q5 C-
3 TCH PROBE 0.1 X+5 Y+0 Z-5
4 END PGM A MM
