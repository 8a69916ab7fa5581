; 6:1 alarm: FL with the tool axis Y: not built yet (with the tool axis Z it is)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TOOL CALL 1 Y
3 L X+0 Z+0 FMAX
4 FL AN+0 LEN10
