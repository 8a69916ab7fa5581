; manner: a generator that writes CYCLE for CYCL, R0 behind the radius of an arc, and an end without name and unit
; shifted by 20, 10: an arc of 15 about 50, 10 over 50, 25; then a hole of 8 at 30, 40 whose second clearance is 52
; at 14: 55, 20, 3
; at 15: 55, 20, -2
; at 16: 85, 20, -2
; at 17: 85, 20, 30
; at 27: 50, 50, 52
; through 27: 50, 50, 2 | 50, 50, -8
; at 30: 90, 50, 52
0 BEGIN PGM BOGEN MM
1 TOOL CALL 1 Z S3000 F500
2 CYCLE DEF 7.0 DATUM SHIFT
3 CYCLE DEF 7.1 X+20 Y+10
4 L X+35 Y+10 Z+3 R0 FMAX M3
5 L Z-2 R0 FAUTO
6 CR X+65 Y+10 R+15 DR- R0 F300
7 L Z+30 R0 FMAX
8 CYCLE DEF 200 DRILLING ~
    Q200=2 ~
    Q201=-8 ~
    Q206=150 ~
    Q202=8 ~
    Q210=0 ~
    Q203=0 ~
    Q204=52 ~
    Q211=0
9 L X+30 Y+40 Z+52 R0 FMAX M99
10 CYCLE DEF 7.0 DATUM SHIFT
11 CYCLE DEF 7.1 X+0 Y+0
12 L X+90 Y+50 R0 FMAX
13 END PGM
