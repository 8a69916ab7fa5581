; 4:1 alarm: SYSSTR ID321 asks for the time, which a run does not have (the setting clock gives it one)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 QS1 = SYSSTR ( ID321 NR 8 )
