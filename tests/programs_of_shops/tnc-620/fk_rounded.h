; manner: vendor's training, FK with an end angle that two lines share
; the first line falls by 45 degrees from (0, 40), the second rises by 45 degrees to (60, 40): they meet at (30, 10)
; at 14: 30, 10, -2
; at 15: 60, 40, -2
; at 16: 90, 40, -2
; at 17: 90, 65, -2
; at 18: 0, 65, -2
0 BEGIN PGM FK2 MM
1 BLK FORM 0.1 Z X+0 Y+0 Z-10
2 BLK FORM 0.2 X+100 Y+100 Z+0
3 TOOL CALL 4 Z S3000 F300
4 L X+0 Y+40 Z+5 R0 FMAX M3
5 L Z-2 F100
6 FL AN-45 F300
7 FL X+60 Y+40 AN+45
8 FL X+90 AN+0
9 FL AN+90 LEN25
10 L X+0
11 L Z+50 R0 FMAX M30
12 END PGM FK2 MM
