0 BEGIN PGM ELLIPSE_ROUND MM ; One round of an ellipse by short lines; ellipse.h calls it. Made for this project.
1 FN 9: IF +Q1 IS DEFINED GOTO LBL "ROUND" ; run alone, it takes these
2 Q1 = 40
3 Q2 = 25
4 Q3 = 72
5 TOOL CALL 1 Z S2000
6 L M3
7 LBL "ROUND"
8 QL1 = 0
9 LBL "NEXT"
10 QL1 = QL1 + 360 / Q3
11 QL2 = Q1 * COS QL1
12 QL3 = Q2 * SIN QL1
13 L X+QL2 Y+QL3 R0 F400
14 FN 12: IF +QL1 LT +359.999 GOTO LBL "NEXT"
15 END PGM ELLIPSE_ROUND MM
