; 3:36 alarm: the depth stands twice (keep one of them)
0 BEGIN PGM A MM
1 DECLARE CONTOUR QC1 = "A" DEPTH5 DEPTH6
9 END PGM A MM
