; 4:9 alarm: FZ (feed per tooth) must be greater than 0, got -1
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 FZ-1
