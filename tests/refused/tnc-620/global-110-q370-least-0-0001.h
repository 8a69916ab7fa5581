; 5:1 alarm: GLOBAL DEF 110 Q370 (path overlap factor) must be at least 0.0001 and at most 1.9999, got 2
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 GLOBAL DEF 110 P
Q370=2
Q351=1
Q366=0
99 END PGM A MM
