; manner: a simulator in the browser: no block numbers, the next tool after each TOOL CALL, feeds of cycles without =
; two holes through a plate of 20, from 2 above it down to 0; the second clearance is 50 above it
; at 16: 0, 0, 70
; at 26: 30, 30, 70
; through 26: 30, 30, 22 | 30, 30, 0
; at 27: 30, -30, 70
; through 27: 30, -30, 22 | 30, -30, 0
BEGIN PGM DEMO MM
; drill two holes through the plate
BLK FORM 0.1 Z X-50 Y-50 Z+0
BLK FORM 0.2 X+50 Y+50 Z+20
TOOL CALL 2 Z S2000 F200
TOOL DEF 1 ; next tool
M3 ; spindle on
M8 ; coolant on
L X+0 Y+0 Z+70 FMAX R0
CYCL DEF 200 ;Drilling
Q200=+2 ;Safety clearance [mm]
Q201=-20 ;Depth [mm]
Q206 FAUTO ;Feed rate [mm/min]
Q202=+20 ;Plunging depth [mm]
Q210=+0 ;Dwell time at top [s]
Q203=+20 ;Surface coordinate [mm]
Q204=+50 ;2nd safety clearance [mm]
Q211=+0 ;Dwell time at depth [s]
L X+30 Y+30 FMAX M99
L X+30 Y-30 FMAX M99
M5
M9
END PGM DEMO MM
