; 5:5 alarm: PR and coordinates of axes stand in one block (write LP PR… PA…)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CC X+5 Y+5
3 L PR+5 PA+0 X+3
