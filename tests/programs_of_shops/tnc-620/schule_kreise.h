; manner: German school, every kind of arc: C, CR, CT, RND
; CT leaves (80, 60) upwards and ends at (60, 60) on a half circle, so its middle is (70, 60)
; at 16: 60, 20, -2
; at 17: 80, 40, -2
; at 19: 60, 60, -2
; at 22: 20, 40, -2
; at 23: 20, 20, -2
; at 24: 20, 20, 50
0 BEGIN PGM KREISE MM
1 BLK FORM 0.1 Z X+0 Y+0 Z-10
2 BLK FORM 0.2 X+100 Y+100 Z+0
3 TOOL CALL 4 Z S4000 F500
4 L X+20 Y+20 Z+20 R0 FMAX M3
5 L Z-2 F200
6 CC X+40 Y+20
7 C X+60 Y+20 DR- F500
8 CR X+80 Y+40 R+20 DR+
9 L Y+60
10 CT X+60 Y+60
11 L Y+40
12 RND R5
13 L X+20
14 CR X+20 Y+20 R-12 DR+
15 L Z+50 R0 FMAX M30
16 END PGM KREISE MM
