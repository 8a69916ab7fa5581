; 4:14 alarm: CC Z0: outside the working plane XY a circle names the two axes of its plane (for example CC X… Z…)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CC X+0 Y+0 Z+0
