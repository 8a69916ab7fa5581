; manner: vendor's training, FK arcs with their middle, FCT by its radius
; at 13: 50, 10, -2
; at 14: 90, 50, -2
; at 15: 50, 90, -2
; at 16: 50, 70, -2
; at 17: 70, 70, -2
; at 18: 70, 10, -2
0 BEGIN PGM FK3 MM
1 BLK FORM 0.1 Z X+0 Y+0 Z-10
2 BLK FORM 0.2 X+100 Y+100 Z+0
3 TOOL CALL 4 Z S3000 F300
4 L X+50 Y+10 Z+5 R0 FMAX M3
5 L Z-2 F100
6 FC DR+ R40 CCX+50 CCY+50 X+90 Y+50 F300
7 FCT DR+ R40 X+50 Y+90
8 FCT DR+ R10 X+50 Y+70
9 FLT LEN20
10 L Y+10
11 L Z+50 R0 FMAX M30
12 END PGM FK3 MM
