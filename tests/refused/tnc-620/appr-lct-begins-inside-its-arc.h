; 4:1 alarm: APPR LCT begins inside of its arc of R8: no line touches the arc from there (take a smaller radius, or a point farther away)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 APPR LCT X+4 Y+0 R8 RL
3 L X+4 Y+9
