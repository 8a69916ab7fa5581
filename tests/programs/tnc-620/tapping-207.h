; origin: manual, CYCL DEF 207, its sequence: to Q200, down at the pitch, reverse, out at the pitch, the spindle stops, out to Q204,
; the spindle turns again as before; pitch 1.25 at S400: 1.25 mm/rev both ways; from Z2 to -20, back to Z2, then to Z50
0 BEGIN PGM C207 MM
1 TOOL CALL 2 Z S400
2 L Z+50 R0 FMAX M3
3 CYCL DEF 207 RIGID TAPPING
Q200=2
Q201=-20
Q239=+1.25
Q203=0
Q204=50
4 L X+10 Y+10 R0 FMAX M99
5 END PGM C207 MM
