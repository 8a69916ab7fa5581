; 4:5 alarm: '+' needs an address before it (the axis letter is missing)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L +250 R0 FMAX
