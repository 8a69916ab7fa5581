; 4:6 alarm: FL PR needs a pole (write FPOL X… Y… before it)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FL PR+10 AN+0
