; 4:6 alarm: DP (distance of parallels) needs PAR, the block of the parallel line
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FL DP5 AN+0
