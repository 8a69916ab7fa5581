; 4:9 alarm: SYSSTR is refused: system texts are not built yet
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 QS1 = SYSSTR ( ID321 NR 8 )
