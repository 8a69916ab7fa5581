; manner: English school, TOOL DEF in the program beside a control with a table, delta values
; tool 12 is that of the block: radius 4, and DR-0.5 makes 3.5: RR along Y0 to +X stands at Y-3.5
; at 14: -20, -20, 20
; at 16: 0, -3.5, -3
; through 17: 60, -3.5, -3
; through 18: 63.5, 40, -3
; at 19: 80, 60, -3
; at 20: 80, 60, 20
0 BEGIN PGM TOOLS MM
1 BLK FORM 0.1 Z X+0 Y+0 Z-10
2 BLK FORM 0.2 X+60 Y+40 Z+0
3 TOOL DEF 12 L+0 R+4
4 TOOL CALL 12 Z S2000 F200 DR-0.5
5 L X-20 Y-20 Z+20 R0 FMAX M3
6 L Z-3 F500
7 L X+0 Y+0 RR F200
8 L X+60
9 L Y+40
10 L X+80 Y+60 R0 FMAX
11 L Z+20 FMAX M30
12 END PGM TOOLS MM
