; 4:10 alarm: FC R5 contradicts what is known of the contour
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FC DR+ R5 CCX+20 CCY+0
