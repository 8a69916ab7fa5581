; 5:10 alarm: U5: secondary axes under radius compensation are not built yet (write R0)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+10 Y+0 RL
3 L X+20 U+5
