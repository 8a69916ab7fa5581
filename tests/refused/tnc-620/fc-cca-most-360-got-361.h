; 4:13 alarm: FC CCA (central angle) must be at most 360, got 361
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FC R5 DR+ CCA361
