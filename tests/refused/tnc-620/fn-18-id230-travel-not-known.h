; 4:24 alarm: FN 18: SYSREAD ID230 NR3 IDX3 (positive limit switch) has no value: the travel of the axis is not known: Setup(limits=mnclab.Limits(travel=…)) says it
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 18: SYSREAD Q30 = ID230 NR3 IDX3
