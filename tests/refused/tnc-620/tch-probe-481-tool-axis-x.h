; 4:1 alarm: TCH PROBE 481 with the tool axis X: not built yet (with the tool axis Z it is)
0 BEGIN PGM P MM
1 TOOL CALL 1 X
2 TCH PROBE 481 X
Q340=1
Q260=+100
Q341=0
9 END PGM P MM
