; 5:9 alarm: W is refused: the secondary axis W is built for L alone
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CC X+0 Y+0
3 C X+0 W+5 DR+
