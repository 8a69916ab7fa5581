; 4:1 alarm: CYCL CALL PAT has no cycle to call (define one before, for example CYCL DEF 200)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL CALL PAT
