0 BEGIN PGM STEPS MM ; Grooves of growing depth, by Q parameters, a repeated label and a subprogram. Made for this project.
1 Q1 = 10 ; from groove to groove
2 FN 0: Q2 = +1 ; depth of the first
3 TOOL CALL 3 Z S4000 F300
4 L X+0 Y+0 Z+5 R0 FMAX M3
5 LBL 1
6 CALL LBL "GROOVE"
7 Q2 = Q2 + 0.5
8 L IX+Q1 FMAX
9 CALL LBL 1 REP4 ; four times more
10 L Z+20 FMAX M30 ; the end: what follows is only called
11 LBL "GROOVE"
12 L Z-Q2 F100
13 L IY+40 FAUTO
14 L Z+5 FMAX
15 L IY-40 FMAX
16 LBL 0
17 END PGM STEPS MM
