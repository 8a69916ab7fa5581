; 4:23 alarm: FN 18: SYSREAD ID320 NR1 IDX0 (system time, seconds from 1970) has no value: a run has no time of day: the setting clock gives it one
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 18: SYSREAD Q1 = ID320 NR1 IDX0
