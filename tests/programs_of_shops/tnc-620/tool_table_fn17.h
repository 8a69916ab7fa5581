; manner: an owner of a machining centre: a program that reads a tool, judges it and writes its row
; Q1 is the radius 5 of tool 1; 0.25 goes into DR, which counts from the next TOOL CALL on; its life of 90 is read back
; at 16: 5, 0, 50
; at 18: 5.25, 0, 50
; at 20: 5.25, 90, 50
; at 25: 5.25, 90, 2
; at 27: 100000 - 0.0001, 90, 2
BEGIN PGM TOOLROW MM
; reads the row of the tool in the spindle
TOOL CALL 1 Z S1000 F300
FN 18: SYSREAD Q8 = ID20 NR1 ; tool in the spindle
FN 18: SYSREAD Q1 = ID50 NR2 IDXQ8 ; R
FN 17: SYSWRITE ID50 NR9 IDXQ8 = +90 ; TIME1
FN 17: SYSWRITE ID50 NR5 IDXQ8 = +0.25 ; DR
FN 17: SYSWRITE ID50 NR21 IDXQ8 = +0 ; LBREAK
L X+Q1 Y+0 Z+50 FMAX
TOOL CALL 1 Z S1000
L X+Q108 FMAX
FN 18: SYSREAD Q9 = ID50 NR9 IDXQ8
L Y+Q9 FMAX
FN 18: SYSREAD Q3 = ID50 NR36 IDXQ8 ; TYPE: a mill is 0
FN 9: IF +Q3 EQU +0 GOTO LBL 1
L Z+77 FMAX
LBL 1
L Z+2 FMAX
FN 18: SYSREAD Q2 = ID50 NR19 IDXQ8 ; R-OFFS
L X+Q2 FMAX
M30
END PGM TOOLROW MM
