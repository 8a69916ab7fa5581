; 5:13 alarm: TOOL CALL cannot change the tool under radius compensation (write R0 first)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 RL
3 TOOL CALL 2 Z
