; manner: post of Fusion 360, cycle 205 over three holes, tool list above
; through 35: 15, -10, -22 | 15, -10, -6 | 15, -10, 15
; at 36: 45, -10, 15
; at 37: 75, -40, 15
0  BEGIN PGM drill-plate MM 
1  BLK FORM 0.1 Z  X+0  Y-50  Z-20
2  BLK FORM 0.2  X+90  Y+0  Z+0
3  ;-------------------------------------
4  ;Tools
5  ;  #2 D=8 TAPER=118deg - ZMIN=-22 - ZMAX=+15 - drill
6  ;-------------------------------------
7  ;
8  * - Drill1
9  TOOL CALL 2 Z S2400
10 M3
11 L  X+15  Y-10 R0 FMAX
12 L  Z+15 R0 FMAX
13 M8
14 CYCL DEF 205 UNIVERSAL PECKING ~
    Q200=+5    ;SET-UP CLEARANCE ~
    Q201=-22   ;DEPTH ~
    Q206=+240  ;FEED RATE FOR PLNGNG ~
    Q202=+6    ;PLUNGING DEPTH ~
    Q203=+0    ;SURFACE COORDINATE ~
    Q204=+15   ;2ND SET-UP CLEARANCE ~
    Q212=+0    ;DECREMENT ~
    Q205=+0    ;MIN. PLUNGING DEPTH ~
    Q258=+0.5  ;UPPER ADV STOP DIST ~
    Q259=+1    ;LOWER ADV STOP DIST ~
    Q257=+0    ;DEPTH FOR CHIP BRKNG ~
    Q256=+0    ;DIST. FOR CHIP BRKNG ~
    Q211=+0    ;DWELL TIME AT DEPTH ~
    Q379=+0    ;STARTING POINT ~
    Q253=+5000 ;F PRE-POSITIONING
15 L FMAX M99
16 L  X+45 FMAX M99
17 L  X+75  Y-40 FMAX M99
18 M9
19 M5
20 M30
21 END PGM drill-plate MM 
