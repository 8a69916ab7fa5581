; 4:9 alarm: M91 cannot begin radius compensation (write RL or RR in the block after)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 M91 RL
