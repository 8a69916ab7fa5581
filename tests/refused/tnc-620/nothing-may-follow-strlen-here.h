; 4:24 alarm: nothing may follow STRLEN ( … ) here (calculate in a block of its own)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 Q1 = STRLEN(SRC_"A") + 1
