; 3:19 alarm: DECLARE CONTOUR stands in a program of contour definitions alone (SEL CONTOUR "NAME" names that program; for a single block there is CONTOUR DEF)
0 BEGIN PGM A MM
1 DECLARE CONTOUR QC1 = "A"
9 END PGM A MM
