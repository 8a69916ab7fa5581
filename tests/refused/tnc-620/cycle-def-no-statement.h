; 4:3 alarm: CYC is no statement of this control (near: CYCL DEF)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYC DEF 9.0 DWELL TIME
