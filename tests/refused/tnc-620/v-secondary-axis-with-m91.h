; 4:5 alarm: V5: secondary axes under M91 or M92 are not built yet
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L V+5 M91 FMAX
