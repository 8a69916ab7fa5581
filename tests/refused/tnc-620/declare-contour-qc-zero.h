; 3:19 alarm: QC0: the designators of contours count from QC1
0 BEGIN PGM A MM
1 DECLARE CONTOUR QC0 = "A"
9 END PGM A MM
