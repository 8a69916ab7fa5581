; origin: worked out from LBL, CALL LBL, REP and FN 3 (catalogue, tnc620-klartext.json)
; Q1 = 5 is doubled by each pass: 10, 20, 40; one pass and REP 2 more: X 10, 10 + 20 = 30, 30 + 40 = 70
; LBL 2 is called once: up to Z10 and back to Z0
0 BEGIN PGM REPEATS MM
1 TOOL CALL 1 Z S1000 F200
2 L X+0 Y+0 Z+0 R0 FMAX M3
3 FN 0: Q1 = +5
4 LBL 1
5 FN 3: Q1 = +Q1 * +2
6 L IX+Q1
7 CALL LBL 1 REP 2
8 CALL LBL 2
9 M30
10 LBL 2
11 L Z+10
12 L Z+0
13 LBL 0
14 END PGM REPEATS MM
