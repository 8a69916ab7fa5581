; 5:9 alarm: M91 cannot stand under radius compensation (write R0 in the block before)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 RL
3 L X+6 M91
