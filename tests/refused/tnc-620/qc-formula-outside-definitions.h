; 4:3 alarm: QC1 = stands in a program of contour definitions alone (SEL CONTOUR "NAME" names that program; for a single block there is CONTOUR DEF)
0 BEGIN PGM A MM
1 L X+0 R0 FMAX
2 QC1 = QC2
