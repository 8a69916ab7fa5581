; manner: vendor's training, FK: an angle and a length, a tangential arc, a point
; FL of 30 at 60 degrees from (20, 20); FC about the given middle (20+30*cos(60)-10*sin(60), 20+30*sin(60)+10*cos(60)), tangential
; at 13: 20, 20, 5
; at 14: 20, 20, -2
; at 16: 20+30*cos(60), 20+30*sin(60), -2
; at 17: 80, 60, -2
; at 18: 80, 40, -2
; at 19: 20, 20, -2
0 BEGIN PGM FK1 MM
1 BLK FORM 0.1 Z X+0 Y+0 Z-10
2 BLK FORM 0.2 X+100 Y+100 Z+0
3 TOOL CALL 4 Z S3000 F300
4 L X+20 Y+20 Z+5 R0 FMAX M3
5 L Z-2 F100
6 FPOL X+20 Y+20
7 FL LEN30 AN+60 F300
8 FL X+80 Y+60
9 FL AN-90 LEN20
10 L X+20 Y+20
11 L Z+50 R0 FMAX M30
12 END PGM FK1 MM
