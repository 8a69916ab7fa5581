; manner: post of Fusion for the TNC 640: TOOL CALL of the axis alone, rolling in by CP in X and Z, a helix by CP with Z
; at 17: 110, -30, 0
; at 18: -10, -30, 0
; at 20: -10, 0, 0
; at 21: 60, 0, 0
; at 23: 60, 20, -1
; at 24: 60, 20, 15
0  BEGIN PGM roll-in MM 
1  BLK FORM 0.1 Z  X+0  Y-60  Z-20
2  BLK FORM 0.2  X+100  Y+0  Z+0
3  TOOL CALL  Z ;SET TOOL AXIS
4  TOOL CALL 4 Z S3000
5  M3
6  L  X+118  Y-30 R0 FMAX
7  L  Z+8 R0 FMAX
8  CC  X+110  Z+8
9  CP IPA+90 DR+ F800
10 L  X-10  Z+0
11 CC  X-10  Y-15
12 CP IPA-180 DR-
13 L  X+60
14 CC  X+60  Y+10
15 CP IPA+180  Z-1 DR+
16 L  Z+15 FMAX
17 M9
18 M5
19 M30
20 END PGM roll-in MM 
