; origin: manual, CYCL DEF 200, its sequence: to Q200 above the surface, pecks of Q202, out to that height after each,
; back to Q200 above the depth reached, Q211 effective at every infeed, at last out to Q204
; surface 0, Q200 = 2: Z2; depth 15 by 6: -6, -12, the last -15; back to -6 + 2 = -4 and -12 + 2 = -10; out to Z20; dwell 0.5 s
0 BEGIN PGM C200 MM
1 TOOL CALL 2 Z S1000
2 L Z+50 R0 FMAX M3
3 CYCL DEF 200 DRILLING
Q200=2
Q201=-15
Q206=250
Q202=6
Q210=0
Q203=0
Q204=20
Q211=0.5
4 L X+30 Y+20 R0 FMAX M99
5 L X+80 FMAX M99
6 END PGM C200 MM
