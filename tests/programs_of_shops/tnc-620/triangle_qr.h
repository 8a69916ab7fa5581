; manner: hobby collection, nested brackets, powers and roots
; 3-4-5: the legs are 30 and 40, the hypotenuse 50; ATAN of 40 over 30 is its angle
; at 17: 0, 0, 7
; at 19: 30, 40, 7
; at 21: 30, 0, -1
; at 22: 0, 0, -1
; at 23: 30, 40, -1
; at 24: 30, 40, 50
0 BEGIN PGM DREIECK MM
1 Q1 = 30 ;;----kathete X----;;
2 Q2 = 40 ;;----kathete Y----;;
3 Q3 = SQRT ( ( Q1 ^ 2 ) + ( Q2 ^ 2 ) )
4 Q4 = ATAN ( Q2 / Q1 )
5 Q5 = INT ( Q3 / 7 ) ;;----7----;;
6 Q6 = ABS ( NEG Q5 )
7 TOOL CALL 4 Z S3000
8 L Z+Q6 R0 FMAX M3
9 CC X+0 Y+0
10 LP PR+Q3 PA+Q4 R0 FMAX
11 L Z-1 F100
12 L X+Q1 Y+0 F300
13 L X+0
14 L X+Q1 Y+Q2
15 L Z+Q3 FMAX M30
16 END PGM DREIECK MM
