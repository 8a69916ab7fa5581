; manner: a program sent by mail, whose long remarks were broken into the next line
; a square of side 40 about 0, 0 milled round its outside by a tool of radius 5, at Z -3, in arcs round its corners
; at 14: -40, 0, -3
; at 17: -25, 20, -3
; at 18: 20, 25, -3
; at 19: 25, -20, -3
; at 20: -20, -25, -3
0 BEGIN PGM QUADRAT MM
; square of forty, clamped in the vice at its left side, stop at
the back, height of the parallels twenty
1 TOOL CALL 1 Z S2500 F400
2 L Z+50 R0 FMAX M3
3 L X-40 Y+0 R0 FMAX
4 L Z-3 R0 F200 ; the floor is finished with the same cutter, so
leave it as it is
5 L X-20 Y+0 RL F400
6 L Y+20
7 L X+20
8 L Y-20
9 L X-20
10 L Y+0
11 L X-40 R0
12 L Z+50 R0 FMAX M30
13 END PGM QUADRAT
