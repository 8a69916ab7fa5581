; 4:1 alarm: TCH PROBE 450 is refused: Saving the kinematics, not built yet: leave it out, it measures the machine
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TCH PROBE 450 X
Q263=1
