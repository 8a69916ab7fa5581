; 4:1 alarm: FC: the free contour is not determined, 2 more data are needed; not known here: centre and end point
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FC DR+ R10
3 L X+5
