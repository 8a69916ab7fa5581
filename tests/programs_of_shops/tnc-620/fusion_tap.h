; manner: post of Fusion 360, rigid tapping called by M99 in blocks without an axis
; at 24: 41.2, -7.5, 5
; at 25: 41.2, -22.5, 5
; through 26: 71.2, -22.5, -34
; at 27: 71.2, -7.5, 5
; at 31: 71.2, -7.5, 500
0  BEGIN PGM tap-m8 MM 
1  BLK FORM 0.1 Z  X+0  Y-30  Z-60
2  BLK FORM 0.2  X+100  Y+0  Z+0
3  * - tap
4  M5
5  TOOL CALL 2 Z S400
6  L M140 MB MAX
7  M3
8  L  X+41.2  Y-7.5 R0 FMAX
9  L  Z+15 R0 FMAX
10 M8
11 CYCL DEF 207 RIGID TAPPING ~
    Q200=+5    ;SET-UP CLEARANCE ~
    Q201=-34   ;DEPTH OF THREAD ~
    Q239=+1.25 ;THREAD PITCH ~
    Q203=+0    ;SURFACE COORDINATE ~
    Q204=+5    ;2ND SET-UP CLEARANCE
12 L FMAX M99
13 L  Y-22.5 FMAX M99
14 L  X+71.2 FMAX M99
15 L  Y-7.5 FMAX M99
16 L  Z+15 FMAX
17 M9
18 M5
19 L M140 MB MAX
20 M30
21 END PGM tap-m8 MM 
