; 7:1 alarm: CYCL DEF 200 Q206 (feed rate for plunging) must be a number, FAUTO, FU, got FMAX (FU has its value behind it, for example Q206=FU0.1)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 200 D
Q200=2
Q201=-15
Q206=FMAX
Q202=5
Q210=0
Q203=0
Q204=20
Q211=0
