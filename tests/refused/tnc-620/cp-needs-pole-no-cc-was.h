; 4:1 alarm: CP needs a pole: no CC was programmed (write CC X… Y… before it)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CP IPA+30 DR+
