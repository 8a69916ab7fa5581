; 6:1 alarm: APPR PLT: the pole CC lies in YZ, approaches and departures in XY
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+10 Y+0
3 CC Y+0 Z+0
4 APPR PLT PR+10 PA+0 LEN5 RL
