; 5:1 alarm: TCH PROBE 480 Q260 (clearance height) must be at least -99999.9999 and at most 99999.9999, got 100000
0 BEGIN PGM P MM
1 TOOL CALL 1 Z
2 TCH PROBE 480 X
Q260=+100000
9 END PGM P MM
