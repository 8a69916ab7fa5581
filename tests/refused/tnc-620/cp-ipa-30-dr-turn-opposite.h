; 5:6 alarm: CP IPA-30 and DR+ turn in opposite senses
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CC X+5 Y+5
3 CP IPA-30 DR+
