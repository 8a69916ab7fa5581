; 7:1 alarm: TCH PROBE 482 Q341 (whether each tooth is measured) must be one of 0, 1, got 2
0 BEGIN PGM P MM
1 TOOL CALL 1 Z
2 TCH PROBE 482 X
Q340=1
Q260=+100
Q341=2
9 END PGM P MM
