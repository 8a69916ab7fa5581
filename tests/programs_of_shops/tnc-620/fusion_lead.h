; manner: post of Fusion 360, lead-in on an arc in YZ, a slot end, lead-out
; YZ arc about Y9.2 Z-3.6 from Y10.6 (angle 0 in Y-Z): -90 degrees gives Y9.2, Z-3.6 - 1.4 = -5
; at 20: 3.6, 10.6, 15
; at 27: 3.6, 9.2, -5
; at 28: 3.6, 7.8, -5
; at 30: 5, 6.4, -5
; at 33: 37, -16.4, -5
; at 36: 5, 6.4, -5
; at 39: 11.4, 7.8, -5
; at 40: 11.4, 10.6, 15
0  BEGIN PGM slots MM 
1  BLK FORM 0.1 Z  X+0  Y-20  Z-40
2  BLK FORM 0.2  X+100  Y+20  Z+0
3  * - 2D Contour2 (3)
4  M5
5  TOOL CALL 5 Z S4043
6  L M140 MB MAX
7  M3
8  L  X+3.6  Y+10.6 R0 FMAX
9  L  Z+15 R0 FMAX
10 M8
11 CYCL DEF 32.0 TOLERANCE
12 CYCL DEF 32.1
13 L  Z+5 FMAX
14 L  Z-3.6 F183
15 CC  Y+9.2  Z-3.6
16 CP IPA-90 DR- F550
17 L  Y+7.8  Z-5
18 CC  X+5  Y+7.8
19 CP IPA+90 DR+
20 L  X+37  Y+6.4
21 CC  X+37  Y-5
22 CP IPA-180 DR-
23 L  X+5  Y-16.4
24 CC  X+5  Y-5
25 CP IPA-180 DR-
26 L  X+10
27 CC  X+10  Y+7.8
28 CP IPA+90 DR+
29 L  Y+10.6  Z+15 FMAX
30 M9
31 M5
32 L M140 MB MAX
33 M30
34 END PGM slots MM 
