; 4:1 alarm: CYCL DEF 25 is refused: Contour train, not built yet
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 25.0 CONTUR
