; origin: worked out from APPR LT and DEP CT (catalogue, tnc620-klartext.json); T0 has the radius 0: the centre runs on the contour
; APPR LT LEN15 to (20, 20), where the contour goes on along +X: the line begins at (20 - 15, 20) = (5, 20)
; DEP CT CCA90 R10 from (60, 20), on the left (RL): a quarter about (60, 20 + 10) to (70, 30), +90
0 BEGIN PGM APPROACH MM
1 TOOL CALL 0 Z S1000 F200
2 L X+0 Y+0 Z+0 R0 FMAX M3
3 APPR LT X+20 Y+20 LEN15 RL
4 L X+60
5 DEP CT CCA90 R10
6 END PGM APPROACH MM
