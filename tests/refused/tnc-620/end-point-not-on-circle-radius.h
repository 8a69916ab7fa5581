; 5:1 alarm: the end point is not on the circle: radius 10.0000 at the start, 11.0000 at the end, allowed difference 0.016 mm
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CC X+10 Y+0
3 C X+21 Y+0 DR+
