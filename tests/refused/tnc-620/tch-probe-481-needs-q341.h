; 4:1 alarm: TCH PROBE 481 Q341 (whether each tooth is measured) is missing
0 BEGIN PGM P MM
1 TOOL CALL 1 Z
2 TCH PROBE 481 X
Q340=1
Q260=+100
9 END PGM P MM
