; 3:19 alarm: DECLARE CONTOUR needs a designator QC and its number (for example DECLARE CONTOUR QC1 = "CIRCLE" DEPTH5)
0 BEGIN PGM A MM
1 DECLARE CONTOUR Q1 = "A"
9 END PGM A MM
