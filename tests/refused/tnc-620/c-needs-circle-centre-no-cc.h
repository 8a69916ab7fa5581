; 4:1 alarm: C needs a circle centre: no CC was programmed (write CC X… Y… before it)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 C X+1 Y+0 DR+
