; 3:14 alarm: an operator is missing (one of & | ^ \)
0 BEGIN PGM A MM
1 QC12 = QC1 QC2
9 END PGM A MM
