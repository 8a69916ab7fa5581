; 4:18 alarm: FN 26 T.TAB: there is no table of this name (Setup(files=…) has no files; the folder of fn-26-no-table.h has none)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 26: TABOPEN T.TAB
