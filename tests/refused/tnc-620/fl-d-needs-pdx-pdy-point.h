; 4:6 alarm: FL D (distance) needs PDX and PDY, the point beside the element
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FL D5 AN+0
