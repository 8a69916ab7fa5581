; origin: manual, CYCL DEF 220, its sequence: to Q204, over the first point, down to Q200, the cycle at Q200,
; with Q301 = 1 to the next point at Q204, and so on; Q247 = 0 shares 360 degrees out: 360 / 4 = 90
; points (50 + 30 cos a, 50 + 30 sin a): (80, 50), (50, 80), (20, 50), (50, 20)
; CYCL DEF 200 at each: from Z2 to -5 in one pass, out to Z20
0 BEGIN PGM C220 MM
1 TOOL CALL 2 Z S1000
2 L Z+50 R0 FMAX M3
3 CYCL DEF 200 DRILLING
Q200=2
Q201=-5
Q206=250
Q202=5
Q210=0
Q203=0
Q204=20
Q211=0
4 CYCL DEF 220 POLAR PATTERN
Q216=+50
Q217=+50
Q244=60
Q245=+0
Q246=+360
Q247=+0
Q241=4
Q200=2
Q203=+0
Q204=20
Q301=1
Q365=0
5 END PGM C220 MM
