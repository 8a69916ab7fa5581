; 4:10 alarm: CR needs an end other than its start (a full circle is written with CC and C)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CR X+0 R5 DR+
