; 4:23 alarm: / and the file that is written are missing (for example FN 16: F-PRINT TNC:\MASK.A / TNC:\LOG.TXT)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 16: F-PRINT LOG.A
