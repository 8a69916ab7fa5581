; 6:10 alarm: DEP CT CCA (centre angle of the arc) must be greater than 0 and at most 360, got 0
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+9 RL
3 L X+20
4 DEP CT CCA0 R3
