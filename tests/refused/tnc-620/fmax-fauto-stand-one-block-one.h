; 4:9 alarm: FMAX and FAUTO stand in one block: one feed is allowed
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 FAUTO FMAX
