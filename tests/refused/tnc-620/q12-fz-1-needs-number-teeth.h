; 6:1 alarm: Q12=FZ.1 needs the number of teeth of tool 6 (column CUT of the tool table)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TOOL CALL 6
3 CYCL DEF 22 D
Q12=FZ.1
