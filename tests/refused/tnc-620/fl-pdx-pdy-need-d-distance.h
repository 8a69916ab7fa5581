; 4:6 alarm: FL PDX PDY need D, the distance of the element from that point
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FL PDX+5 PDY+5 AN+0
