0 BEGIN PGM ELLIPSE_ROUND MM ; One round of an ellipse by short lines; ellipse.h calls it. Made for this project.
1 FN 9: IF +Q1 IS DEFINED GOTO LBL "ROUND" ; run alone, it takes these
2 Q1 = 40
3 Q2 = 25
4 Q3 = 72
5 LBL "ROUND"
6 QL1 = 0
7 LBL "NEXT"
8 QL1 = QL1 + 360 / Q3
9 QL2 = Q1 * COS QL1
10 QL3 = Q2 * SIN QL1
11 L X+QL2 Y+QL3 R0 F400
12 FN 12: IF +QL1 LT +359.999 GOTO LBL "NEXT"
13 END PGM ELLIPSE_ROUND MM
