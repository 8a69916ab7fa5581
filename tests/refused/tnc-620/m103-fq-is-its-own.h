; 4:15 alarm: no value was given to Q1
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 M103 FQ1
