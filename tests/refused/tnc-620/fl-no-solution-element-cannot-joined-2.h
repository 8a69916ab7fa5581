; 5:1 alarm: FL has no solution: the element cannot be joined to what is known of the contour
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FC DR- R30 CCX+30 CCY+0
3 FL AN+0 PDX+30 PDY+90 D10
