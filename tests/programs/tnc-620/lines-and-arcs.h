; origin: worked out from L, CC, C, CR and CT (catalogue, tnc620-klartext.json)
; C about (10, 0) from (20, 0) to (10, 10): a quarter, +90
; CR R+5 DR- from (10, 10) to (0, 10): the half circle about (5, 10) by way of (5, 5), -180; at (0, 10) it runs upwards
; CT from there to (10, 0): the centre (r, 10) is as far from both: (10 - r)^2 + 100 = r^2, r = 10; clockwise from 180 degrees
; over (10, 20) and (20, 10) to 270 degrees below: -270
; the last L counts from (10, 0, -2): (15, 0, 5)
0 BEGIN PGM ARCS MM
1 TOOL CALL 1 Z S1000 F200
2 L X+20 Y+0 Z+5 R0 FMAX M3
3 L Z-2
4 CC X+10 Y+0
5 C X+10 Y+10 DR+
6 CR X+0 Y+10 R+5 DR-
7 CT X+10 Y+0
8 L IX+5 IZ+7 FMAX
9 END PGM ARCS MM
