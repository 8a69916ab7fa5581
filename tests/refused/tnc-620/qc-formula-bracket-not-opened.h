; 3:24 alarm: this bracket was not opened
0 BEGIN PGM A MM
1 QC12 = ( QC1 | QC2 ) ) \ QC3
9 END PGM A MM
