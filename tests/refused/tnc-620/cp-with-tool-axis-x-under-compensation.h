; 9:1 alarm: CP: an arc in XY cannot stand under radius compensation, which lies in YZ (write R0 in a straight line before it)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TOOL CALL 1 X F100
3 L X+0 Y+0 Z+0 FMAX M3
4 L Y+10 RL
5 L Z+20
6 CC X+0 Y+0
7 CP IPA+90 DR+
