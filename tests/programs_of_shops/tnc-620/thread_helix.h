; manner: vendor's training, thread milling by hand: helix with CP IPA IZ from below
; thread M20 x 2, tool radius 3: centre on the radius 10 - 3 = 7; three turns up by 2 each
; at 16: 0, 0, 5
; at 17: 0, 0, -12
; at 19: 7, 0, -12
; at 22: 7, 0, -6
; at 23: 0, 0, -6
; at 24: 0, 0, 50
0 BEGIN PGM GEWINDE MM
1 BLK FORM 0.1 Z X-20 Y-20 Z-20
2 BLK FORM 0.2 X+20 Y+20 Z+0
3 Q1 = 20 ; NENNDURCHMESSER
4 Q2 = 2 ; STEIGUNG
5 TOOL CALL 3 Z S3000 F200
6 Q3 = Q1 / 2 - Q108 ; BAHNRADIUS
7 L X+0 Y+0 Z+5 R0 FMAX M3
8 L Z-12 FMAX
9 CC X+0 Y+0
10 L X+Q3 Y+0 F100
11 Q4 = 3 * 360
12 Q5 = 3 * Q2
13 CP IPA+Q4 IZ+Q5 DR+ F200
14 L X+0 Y+0 R0 FMAX
15 L Z+50 FMAX M30
16 END PGM GEWINDE MM
