; manner: vendor's collection of parameter programs, a spiral of lines counted by FN
; radius 20 less 1 each quarter, up by 0.5: after k quarters radius 20 - k at 90 k degrees, Z -4 + k / 2
; at 18: 70, 50, 0
; at 19: 70, 50, -4
; at 31: 50, 69, -3.5 | 32, 50, -3 | 50, 33, -2.5 | 66, 50, -2
; at 33: 60, 50, -2
0 BEGIN PGM KONUS MM
1 ;Die Werkzeugbahn wird in lineare Schritte
2 ;aufgeteilt.
3 FN 0: Q1 =+50 ;MITTE X
4 FN 0: Q2 =+50 ;MITTE Y
5 FN 0: Q26 =+20 ;RADIUS
6 FN 0: Q27 =+0 ;WINKEL
7 FN 0: Q23 =-4 ;Z START
8 FN 0: Q25 =+0 ;ZAEHLER
9 TOOL CALL 4 Z S5000
10 CC X+Q1 Y+Q2 ;Mittelpunkt definieren
11 LP PR+Q26 PA+Q27 R0 FMAX M3 ;Vorpositionieren
12 L Z+Q23 R0 F300
13 LBL 2 ;Wiederholung
14 FN 2: Q26 =+Q26 - +1
15 FN 1: Q27 =+Q27 + +90
16 FN 7: Q21 =COS +Q27
17 FN 3: Q21 =+Q21 * +Q26
18 FN 1: Q21 =+Q21 + +Q1
19 FN 6: Q22 =SIN +Q27
20 FN 3: Q22 =+Q26 * +Q22
21 FN 1: Q22 =+Q22 + +Q2
22 FN 1: Q23 =+Q23 + +0.5
23 FN 1: Q25 =+Q25 + +1
24 L X+Q21 Y+Q22 Z+Q23 F500 ;Neue Koordinaten
25 FN 12: IF +Q25 LT +4 GOTO LBL 2 ;Vergleich
26 LP IPR-6
27 L Z+100 R0 FMAX M30
28 END PGM KONUS MM
