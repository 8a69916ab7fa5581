; 4:3 alarm: M142 is refused: erasing modal information, a function of older controls that is not built: write the functions again that are to hold
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 M142
