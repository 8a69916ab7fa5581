; 5:7 alarm: LBL "A" is set twice (a label stands for one place in the program)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 LBL "A"
3 LBL "A"
