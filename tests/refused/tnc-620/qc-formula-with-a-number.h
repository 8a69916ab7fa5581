; 3:16 alarm: a formula of contours holds QC, operators and brackets (for example QC10 = ( QC1 | QC2 ) \ QC3)
0 BEGIN PGM A MM
1 QC12 = QC1 | 5
9 END PGM A MM
