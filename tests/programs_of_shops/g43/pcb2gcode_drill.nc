( pcb2gcode 2.5.0 )
( This file uses 2 drill bit sizes. )
( Bit sizes: [0.8mm] [1mm] )

G94       (Inches per minute feed rate.)
G20       (Units == INCHES.)
G90       (Absolute coordinates.)
S12000    (RPM spindle speed.)

G00 Z1.00000 (Retract)
T1
M5      (Spindle stop.)
G04 P1.00000
(MSG, Change tool bit to drill size 0.8mm)
M6      (Tool change.)
M3      (Spindle on clockwise.)
G04 P1.00000

G81 R0.10000 Z-0.07500 F10.00000 X0.20000 Y0.30000
X0.40000 Y0.30000
X0.40000 Y0.90000

T2
M5
M6      (Tool change.)
M3
G81 R0.10000 Z-0.07500 F10.00000 X1.20000 Y0.90000
X1.50000 Y0.90000

G00 Z1.000 ( All done -- retract )
M5      (Spindle off.)
M9      (Coolant off.)
M2      (Program end.)
