; origin: worked out from RND and CHF (catalogue, tnc620-klartext.json, PGM C25: RND R7.5 touches 7.5 before a right angle)
; corner (20, 0): RND R5 touches at (15, 0) and (20, 5), centre (15, 5), a left turn: +90
; corner (20, 20): CHF 4 from (20, 16) to (16, 20)
; corner (0, 20): RND R2 touches at (2, 20) and (0, 18), centre (2, 18), +90, with F50 for the arc alone
0 BEGIN PGM CORNERS MM
1 TOOL CALL 1 Z S1000 F200
2 L X+0 Y+0 Z+0 R0 FMAX M3
3 L X+20
4 RND R5
5 L Y+20
6 CHF 4
7 L X+0
8 RND R2 F50
9 L Y+0
10 END PGM CORNERS MM
