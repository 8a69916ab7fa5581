; manner: German school, first contour with RL and tangential approach on an arc
; RL up along X10 stands at X5, along Y70 at Y75, down X90 at X95, back along Y10 at Y5; corners are RND or CHF
; at 13: 0, 0, 100
; at 14: -30, 40, 100
; at 16: 5, 40, -5
; at 25: 5, 40, -5
; at 26: -30, 40, -5
; at 27: -30, 40, 100
0  BEGIN PGM RECHTECK MM 
1  BLK FORM 0.1 Z X+0 Y+0 Z-20 ; Rohteil
2  BLK FORM 0.2 X+100 Y+80 Z+0
3  TOOL CALL 1 Z S2500 F400 ; Schaftfraeser 10
4  L  Z+100 R0 FMAX M3
5  L  X-30 Y+40 R0 FMAX M8
6  L  Z-5 R0 FMAX
7  APPR LCT X+10 Y+40 R8 RL F400
8  L  Y+70
9  RND R10
10 L  X+90
11 CHF 10
12 L  Y+10
13 RND R10
14 L  X+10
15 RND R10
16 L  Y+40
17 DEP LCT X-30 Y+40 R8
18 L  Z+100 R0 FMAX M30
19 END PGM RECHTECK MM 
