; manner: a hobby post with decimal commas, one axis a block, M3 alone
; at 13: 3.5, 2.25, 5
; at 15: 3.5, 17.75, -0.3
; at 16: 12.125, 17.75, -0.3
; at 17: 12.125, 2.25, -0.3
; at 19: 3.5, 2.25, 5
BEGIN PGM GRAVUR MM
BLK FORM 0.1 Z X+0 Y+0 Z-5
BLK FORM 0.2 X+60 Y+20 Z+0
TOOL CALL 4 Z S12000
M3
L Z+5,000 FMAX
L X+3,500 Y+2,250 FMAX
L Z-0,300 F200
L X+3,500 Y+17,750 F600
L X+12,125
L Y+2,250
L X+3,500
L Z+5,000 FMAX
M5
L Z+50 FMAX M30
END PGM GRAVUR MM
