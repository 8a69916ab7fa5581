; 4:3 alarm: FOO is no statement of this control
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FOO 3
