; 4:13 alarm: FC runs at feed: FMAX is for straight lines
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FC DR+ R5 FMAX
