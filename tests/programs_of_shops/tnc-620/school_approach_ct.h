; manner: English school, APPR CT and DEP CT on quarter circles
; RL upwards along X0 stands at X-5; the approach on an arc of 10 (of the tool centre) over 90 degrees begins at (-15, 20)
; at 13: -40, 10, -10
; through 14: -15, 20, -10 | -5, 30, -10
; at 15: -5, 60, -10
; at 16: -15, 70, -10
; at 17: -40, 70, -10
0 BEGIN PGM APPRCT MM
1 BLK FORM 0.1 Z X+0 Y+0 Z-30
2 BLK FORM 0.2 X+50 Y+80 Z+0
3 TOOL CALL 1 Z S1800 F250
4 L X-40 Y+10 R0 FMAX M3
5 L Z-10 F500
6 APPR CT X+0 Y+30 CCA90 R+10 RL F250
7 L Y+60
8 DEP CT CCA90 R+10
9 L X-40 R0 FMAX
10 L Z+50 R0 FMAX M30
11 END PGM APPRCT MM
