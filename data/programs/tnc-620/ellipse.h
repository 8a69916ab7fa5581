0 BEGIN PGM ELLIPSE MM ; An ellipse in four depths, each round in another program. Made for this project.
1 BLK FORM 0.1 Z X-50 Y-50 Z-20
2 BLK FORM 0.2 X+50 Y+50 Z+0
3 TOOL CALL 4 Z S3000 F400
4 Q1 = 40 ; half axis in X
5 Q2 = 25 ; half axis in Y
6 Q3 = 72 ; lines of a round
7 Q4 = -2 ; first depth
8 L Z+50 R0 FMAX M3
9 L X+Q1 Y+0 FMAX
10 L Z+2 FMAX
11 LBL "DEPTH"
12 L Z+Q4 F150
13 CALL PGM ELLIPSE_ROUND
14 Q4 = Q4 - 2
15 FN 11: IF +Q4 GT -8.5 GOTO LBL "DEPTH"
16 L Z+50 FMAX M30
17 END PGM ELLIPSE MM
