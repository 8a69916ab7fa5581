; 6:13 alarm: CP Z3: the pole lies in ZX, a helix has its end in Y
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CC X+0 Z+5
3 L X+10
4 CP IPA+90 Z+3 DR+
