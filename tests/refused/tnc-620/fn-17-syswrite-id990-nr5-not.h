; 4:19 alarm: FN 17: SYSWRITE ID990 NR5 is not built yet (ID990 NR6 is, and columns of the tool table, ID50)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 17: SYSWRITE ID 990 NR 5 = +1
