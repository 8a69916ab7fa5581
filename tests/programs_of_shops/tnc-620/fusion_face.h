; manner: post of Fusion 360 for Heidenhain, facing in passes; M140 MB MAX goes to Z500 (retract_to)
; the arc down turns from Z to X: from X+1.6 beside its middle (90 degrees) to 180 degrees, 1.6 below it
; at 20: 0, 0, 500
; at 25: 134.6, -52, 500
; at 33: 133, -52, 0
; at 37: -8, -32, 0
; at 40: 120, -12, 0
; at 42: 0, -12, 15
; at 45: 0, -12, 500
0  BEGIN PGM stock-face MM 
1  BLK FORM 0.1 Z  X+0  Y-60  Z-20
2  BLK FORM 0.2  X+120  Y+0  Z+1
3  ;-------------------------------------
4  ;Tools
5  ;  #5 D=16 - ZMIN=+0 - ZMAX=+15 - flat end mill
6  ;-------------------------------------
7  ;
8  * - Face1
9  TOOL CALL  Z ;SET TOOL AXIS FOR M140
10 L M140 MB MAX
11 M5
12 TOOL CALL 5 Z S5000
13 L M140 MB MAX
14 M3
15 L  X+134.6  Y-52 R0 FMAX
16 L  Z+15 R0 FMAX
17 M8
18 CYCL DEF 32.0 TOLERANCE
19 CYCL DEF 32.1
20 L  Z+5 FMAX
21 L  Z+1.6 F333
22 CC  X+133  Z+1.6
23 CP IPA+90 DR+ F1000
24 L  Z+0
25 L  X-8
26 CC  X-8  Y-42
27 CP IPA-180 DR-
28 L  X+120
29 CC  X+120  Y-22
30 CP IPA+180 DR+
31 L  X+0
32 L  Z+15 FMAX
33 M9
34 M5
35 L M140 MB MAX
36 M30
37 END PGM stock-face MM 
