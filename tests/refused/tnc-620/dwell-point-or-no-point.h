; 5:22 alarm: .5 may be 0.5 or 5 (write a blank before the number, and a digit before its point)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 9.0 X
3 CYCL DEF 9.1 V.ZEIT.5
