; 4:1 alarm: FN 16 is refused: formatted output, not built yet
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 16: F-PRINT A.A / A.TXT
