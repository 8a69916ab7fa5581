; 4:1 alarm: FN 26 is refused: opening a table, not built yet
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 26: TABOPEN A.TAB
