; 4:9 alarm: Q113 (unit of the main program) is kept by the control and cannot be assigned (take another parameter)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 0: Q113 = 1
