; 3:3 alarm: QC0: the designators of contours count from QC1
0 BEGIN PGM A MM
1 QC0 = QC1
9 END PGM A MM
