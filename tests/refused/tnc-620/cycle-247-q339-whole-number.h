; 5:1 alarm: CYCL DEF 247 Q339 (number of the preset) must be a whole number and at least 0 and at most 65535, got 1.5
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 247 X
Q339=+1.5
