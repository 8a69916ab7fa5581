; 5:1 alarm: CYCL DEF 200 Q200 (set-up clearance) must be a number, got FMAX
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 200 X
Q200=MAX
