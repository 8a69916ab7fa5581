; 5:14 alarm: CR Z0: outside the working plane XY a circle names the two axes of its plane (for example CR X… Z…)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+10
3 CR X+5 Y+5 Z+0 R+10 DR+
