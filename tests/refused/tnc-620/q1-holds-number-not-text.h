; 4:8 alarm: Q1 holds a number, not a text (texts stand in QS parameters)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 Q1 = "A"
