; 4:1 alarm: TRANS DATUM is refused: datum shift of a table, not built yet: write CYCL DEF 7 with # and the row of the table
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TRANS DATUM TABLE TABLINE25
