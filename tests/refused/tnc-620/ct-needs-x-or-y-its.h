; 5:1 alarm: CT needs X or Y of its end
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5
3 CT
