; 6:7 alarm: LBL 1 is set twice (a label stands for one place in the program)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 LBL 1
3 LBL 0
4 LBL 1
