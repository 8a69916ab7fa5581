; 15:1 alarm: CYCL DEF 214 Q222 (diameter of the rough pocket) must be less than the diameter of the finished pocket Q223, 80, got 80
BEGIN PGM A MM
TOOL CALL 1 Z S1000
L X+20 Y+10 Z+2 R0 FMAX M3
CYCL DEF 214 X
Q200=2
Q201=-20
Q206=150
Q202=8
Q207=500
Q203=0
Q204=50
Q216=50
Q217=40
Q222=80
Q223=80
CYCL CALL
END PGM A MM
