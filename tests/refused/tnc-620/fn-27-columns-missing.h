; 4:21 alarm: the columns in quotes are missing (for example FN 27: TABWRITE 5/"X,Y" = Q5)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 27: TABWRITE 5/X = Q5
