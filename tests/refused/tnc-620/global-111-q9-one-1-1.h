; 8:1 alarm: GLOBAL DEF 111 Q9 (sense of milling) must be one of 1, -1, got 2
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 GLOBAL DEF 111 C
Q2=1
Q6=2
Q7=50
Q9=2
99 END PGM A MM
