; 5:1 alarm: FPOL with the tool axis X: not built yet (with the tool axis Z it is)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TOOL CALL 1 X
3 FPOL X+0 Y+0
