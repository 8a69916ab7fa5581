; 5:1 alarm: TCH PROBE 484 Q536 (stop before running) must be one of 0, 1, got 2
0 BEGIN PGM P MM
1 TOOL CALL 1 Z
2 TCH PROBE 484 X
Q536=2
9 END PGM P MM
