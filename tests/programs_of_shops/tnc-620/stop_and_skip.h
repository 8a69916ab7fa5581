; manner: shop programs: skipped blocks with /, STOP M6, comments in capitals; skip is off
; at 15: 10, 10, 100
; at 16: 20, 10, 100
; at 18: 20, 10, -2
; at 19: 20, 30, -2
; at 20: 50, 30, -2
; at 22: 50, 30, 100
0 BEGIN PGM KLEIN MM
; AUFSPANNUNG 1
1 BLK FORM 0.1 Z X+0 Y+0 Z-20
2 BLK FORM 0.2 X+100 Y+60 Z+0
* - FRAESEN
3 TOOL CALL 1 Z S2000 F400
4 L Z+100 R0 FMAX M3
5 L X+10 Y+10 FMAX
/ 6 L X+20 FMAX
7 STOP M6
8 L Z-2 F200 M3
/9 L Y+30
10 L X+50 F400 M8
11 M9 M5
12 L Z+100 FMAX M30
13 END PGM KLEIN MM
