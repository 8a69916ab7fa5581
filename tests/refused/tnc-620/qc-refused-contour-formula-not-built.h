; 4:1 alarm: QC is refused: contour formula, not built yet
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 QC1 = QC2 | QC3
