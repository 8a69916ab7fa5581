; 4:21 alarm: PATTERN DEF POS1 X must be absolute (POS2 to POS9 may count from the one before)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 PATTERN DEF POS1 (IX+5 Y+0 Z+0)
99 END PGM A MM
