; 5:1 alarm: CYCL DEF 200 Q206 (feed rate for plunging) must be a number, FAUTO, FU, got FZ.1 (FU has its value behind it, for example Q206=FU0.1)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 200 D
Q206=FZ.1
