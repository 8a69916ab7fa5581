; 5:1 alarm: GLOBAL DEF 100 Q200 (set-up clearance) has no default: PREDEF is not allowed (write its value)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 GLOBAL DEF 100 G
Q200=PREDEF
99 END PGM A MM
