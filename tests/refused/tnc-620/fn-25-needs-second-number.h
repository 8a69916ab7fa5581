; 4:25 alarm: / is missing (for example FN 25: PRESET = X/+100/+0)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 25: PRESET = X/+100
