; 5:1 alarm: CT: the end lies straight behind the element before, no tangential arc leads there
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5
3 CT X+2
