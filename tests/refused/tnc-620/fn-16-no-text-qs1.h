; 4:26 alarm: no text was given to QS1
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 16: F-PRINT LOG.A / :'QS1'.TXT
