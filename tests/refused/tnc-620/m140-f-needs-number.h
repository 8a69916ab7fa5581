; 4:15 alarm: M140 F needs a number (for example M140 MB 50 F750)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L M140 MB50 F
