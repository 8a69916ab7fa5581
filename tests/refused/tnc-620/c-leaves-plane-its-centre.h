; 5:10 alarm: C Z5: the circle centre CC lies in XY (write CC Z… before it)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CC X+5 Y+0
3 C X+10 Z+5 DR+
