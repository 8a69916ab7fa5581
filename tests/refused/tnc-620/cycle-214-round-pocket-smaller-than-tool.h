; 16:1 alarm: CYCL DEF 214 Q223 (diameter of the finished pocket) must be at least three times the tool radius, 15, got 9
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
Q222=0
Q223=9
CYCL CALL
END PGM A MM
