; 5:12 alarm: PR5 has no meaning in this block (CP does not take PR)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CC X+5 Y+5
3 CP PA+30 PR+5 DR+
