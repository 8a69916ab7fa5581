; 5:5 alarm: A under M116 (feed of rotary axes in mm/min) is not built yet
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 M116
3 L A+5
