; 4:29 alarm: Q and the number of the result parameter stand here, for example Q5
0 BEGIN PGM A MM
1 TOOL CALL 6 Z
2 TCH PROBE 0.0 REF. PLANE X-
3 TCH PROBE 0.1 X+5 Y+0 Z-5
4 END PGM A MM
