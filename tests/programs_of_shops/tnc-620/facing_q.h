; manner: hobby collection, facing with parameters and comments for the operator, ** lines
; at 11: 0, 0, 50
; at 20: -50, -20, 50
; at 23: 50, -20, -1 | 50, -8, -1 | 50, 4, -1 | 50, 16, -1
; at 27: -50, -8, 1 | -50, 4, 1 | -50, 16, 1
; at 31: 50, 16, 300
0 BEGIN PGM Plan-Beispiel MM
1 BLK FORM 0.1 Z X-50 Y-20 Z-30
2 BLK FORM 0.2 X+50 Y+20 Z+0
3 TOOL CALL 5 Z S800
4 L X+0 Y+0 Z+50 R0 FMAX M3
5 ;----- Zyklus Planfraesen Parameter -----
6 Q1800 = - 50 ;Startpunkt X
7 Q1801 = 50 ;Endpunkt X
8 Q1802 = - 20 ;Startpunkt Y
9 Q1803 = 20 ;Endpunkt Y
10 Q1805 = - 1 ;Tiefe
11 Q1814 = 2 * Q108 * 0.75 ;Bahnabstand
12 Q1815 = Q1802
13 L X+Q1800 Y+Q1815 FMAX
14 L Z+Q1805 F200
15 LBL 1
16 L X+Q1801 F600
17 Q1815 = Q1815 + Q1814
18 FN 11: IF +Q1815 GT +Q1803 GOTO LBL 99
19 L Z+1 FMAX
20 L X+Q1800 Y+Q1815 FMAX
21 L Z+Q1805 F200
22 FN 9: IF +0 EQU +0 GOTO LBL 1
23 LBL 99
24 L Z+300 R0 FMAX M5
25 L M30
26 END PGM Plan-Beispiel MM
