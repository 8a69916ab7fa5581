; 4:1 alarm: TCH PROBE 480 Q260 (clearance height) is missing
0 BEGIN PGM P MM
1 TOOL CALL 1 Z
2 TCH PROBE 480 X
9 END PGM P MM
