; 5:17 alarm: a number is missing: the clearance height
0 BEGIN PGM P MM
1 TOOL CALL 1 Z
2 TCH PROBE 30.0 X
3 TCH PROBE 30.1
9 END PGM P MM
