; origin: worked out from CC, LP and CP (catalogue, tnc620-klartext.json, PGM CIRCLE1: centre (75, 50), radius 45)
; LP at 0 degrees: 75 + 45 = 120; a full circle +360 back to (120, 50)
; LP PR+20 PA+90: (75, 50 + 20); IPA+90: at 180 degrees (75 - 20, 50)
; CP IPA-180 DR-: half a turn to 0 degrees, (75 + 20, 50), while Z rises by 4 from 0
0 BEGIN PGM POLAR MM
1 TOOL CALL 1 Z S1000 F200
2 L X+75 Y+50 Z+0 R0 FMAX M3
3 CC X+75 Y+50
4 LP PR+45 PA+0
5 CP IPA+360 DR+
6 LP PR+20 PA+90
7 LP IPA+90
8 CP IPA-180 IZ+4 DR-
9 END PGM POLAR MM
