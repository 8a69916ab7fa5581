; 3:5 alarm: the number of a parameter, or of a contour, has no sign (for example QC10 =)
0 BEGIN PGM A MM
1 QC-1 = QC2
9 END PGM A MM
