; 4:14 alarm: M103 F needs a number (for example M103 F20: 20 percent)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 M103 F
