; 7:1 alarm: GLOBAL DEF 120 Q301 (height between measuring points) must be one of 0, 1, got 2
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 GLOBAL DEF 120 P
Q320=0
Q260=100
Q301=2
99 END PGM A MM
