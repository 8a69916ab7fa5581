; 6:1 alarm: Q206=FU0.1 needs a spindle speed (write S in the TOOL CALL block before the definition)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TOOL CALL S0
3 CYCL DEF 200 D
Q206=FU0.1
