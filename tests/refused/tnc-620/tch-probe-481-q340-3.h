; 5:1 alarm: TCH PROBE 481 Q340 (what becomes of the measured values) must be one of 0, 1, 2, got 3
0 BEGIN PGM P MM
1 TOOL CALL 1 Z
2 TCH PROBE 481 X
Q340=3
Q260=+100
Q341=0
9 END PGM P MM
