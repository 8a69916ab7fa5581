; 3:16 alarm: a designator is missing before the operator (for example QC10 = ( QC1 | QC2 ) \ QC3)
0 BEGIN PGM A MM
1 QC12 = QC1 | | QC2
9 END PGM A MM
