; 5:1 alarm: GLOBAL DEF 125 Q345 (positioning height between points) must be one of 0, 1, got 2
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 GLOBAL DEF 125 P
Q345=2
99 END PGM A MM
