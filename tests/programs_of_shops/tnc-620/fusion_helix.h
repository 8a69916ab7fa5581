; manner: post of Fusion 360, bore on a helix with CC and CP IPA IZ
; at 17: 9, 0, -8
; at 18: 9, 0, -8
; at 19: 0, 9, -6
; at 20: 0, 0, -6
; at 21: 0, 0, 15
0  BEGIN PGM bore MM 
1  BLK FORM 0.1 Z  X-30  Y-30  Z-15
2  BLK FORM 0.2  X+30  Y+30  Z+0
3  * - Bore1
4  TOOL CALL 3 Z S6000
5  M3
6  L  X+9  Y+0 R0 FMAX
7  L  Z+5 FMAX
8  L  Z+1 F600
9  CC  X+0  Y+0
10 CP IPA+1080 IZ-9 DR+ F800
11 CP IPA+360 DR+
12 CP IPA+90 IZ+2 DR+
13 L  X+0  Y+0
14 L  Z+15 FMAX
15 M5
16 M30
17 END PGM bore MM 
