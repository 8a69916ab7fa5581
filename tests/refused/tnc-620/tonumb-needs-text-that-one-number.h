; 4:8 alarm: TONUMB needs a text that is one number, got "8A"
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 Q1 = TONUMB ( SRC_"8A" )
