( pcb2gcode 2.5.0 )
( Software-independent Gcode )

G94 (Inches per minute feed rate.)
G20 (Units == INCHES.)

G90 (Absolute coordinates.)
S10000 (RPM spindle speed.)
G64 P0.00100 (set maximum deviation from commanded toolpath)
F12.00000 (Feedrate.)

M3 (Spindle on clockwise.)
G04 P0 (dwell for no time -- G64 should not smooth over this point)
G00 Z0.10000 (retract)

G00 X0.15000 Y0.22500 ( rapid move to begin. )
G01 Z-0.00500
G04 P0 (dwell for no time -- G64 should not smooth over this point)
G01 X0.25000 Y0.22500
G01 X0.30000 Y0.27500
G01 X0.30000 Y0.40000
G01 X0.15000 Y0.22500

G04 P0 (dwell for no time -- G64 should not smooth over this point)
G00 Z0.10000 (retract)
M5 (Spindle off.)
G04 P1.000000
M9 (Coolant off.)
M2 (Program end.)
