; 4:15 alarm: FAUTO and FZ0.1 stand in one block: one feed is allowed
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 FAUTO FZ,1
