; 4:12 alarm: M140 needs MB and a distance, or MB MAX (for example M140 MB MAX or M140 MB 50)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 F9 M140
