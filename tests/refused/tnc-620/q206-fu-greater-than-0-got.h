; 5:1 alarm: Q206=FU (feed per revolution) must be greater than 0, got 0
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 200 D
Q206=FU0
