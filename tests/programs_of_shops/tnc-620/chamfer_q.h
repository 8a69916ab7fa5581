; manner: hobby collection: a chamfer in steps by FN 4 and FN 12 under M90
; steps of 0.5 up from Z-2, each 0.5 further in
; at 14: 40, 0, 5
; at 15: 40, 0, -2
; at 17: 39.5, 0, -1.5 | 39, 0, -1 | 38.5, 0, -0.5 | 38, 0, 0
; at 18: 39.5, 20, -1.5 | 39, 20, -1 | 38.5, 20, -0.5 | 38, 20, 0
; at 22: 38, 0, 100
0 BEGIN PGM FASE MM
1 FN 0: Q1 =+2 ;HOEHE
2 FN 0: Q2 =+4 ;SCHRITTE
3 FN 4: Q3 =+Q1 DIV +Q2
4 FN 0: Q4 =+0
5 TOOL CALL 3 Z S2000 F500
6 L X+40 Y+0 Z+5 R0 FMAX M3
7 L Z-Q1 F100
8 LBL 1
9 L IX-Q3 IZ+Q3 R0 M90
10 L IY+20 M90
11 L IY-20
12 FN 1: Q4 =+Q4 + +1
13 FN 12: IF +Q4 LT +Q2 GOTO LBL 1
14 L Z+100 R0 FMAX M30
15 END PGM FASE MM
