; manner: English school, stepped block with RR and LN approach, dep LT
; RR going up along X20 stands at X20 + 5 = 25; LN of 10 comes from the right: from X25 + 10
; at 13: 60, 20, 0
; through 15: 35, 20, -10 | 25, 20, -10
; at 16: 25, 80, -10
; at 17: 25, 95, -10
; at 18: 60, 95, -10
; at 19: 60, 95, 50
0 BEGIN PGM STEP MM
1 BLK FORM 0.1 Z X+0 Y+0 Z-30
2 BLK FORM 0.2 X+20 Y+100 Z+0
3 TOOL CALL 1 Z S1800 F250
4 L X+60 Y+20 R0 FMAX M3
5 L Z-10 F500
6 APPR LN X+20 Y+20 LEN10 RR F250
7 L Y+80
8 DEP LT LEN15 F400
9 L X+60 R0 FMAX
10 L Z+50 R0 FMAX M30
11 END PGM STEP MM
