; 4:20 alarm: POS needs its words in brackets (write POS1 (X+… Y+…))
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 PATTERN DEF POS1 X+5 Y+0 Z+0
99 END PGM A MM
