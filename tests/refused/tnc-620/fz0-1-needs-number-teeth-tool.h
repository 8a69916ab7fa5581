; 5:9 alarm: FZ0.1 needs the number of teeth of tool 6 (column CUT of the tool table)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TOOL CALL 6 Z
3 L X+1 FZ0.1 M3
