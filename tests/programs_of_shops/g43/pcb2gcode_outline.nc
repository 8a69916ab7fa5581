( pcb2gcode )
G94 ( Inches per minute feed rate. )
G20 ( Units == INCHES. )
G90 ( Absolute coordinates. )
G00 S8000 ( RPM spindle speed. )
G64 P0.01 ( set maximum deviation )
G01 F20 ( Feedrate )
M3 ( Spindle on clockwise. )
G00 Z0.1
G00 X-0.0500 Y-0.0500 ( rapid move to begin. )
G01 Z-0.0250 F10 ( plunge. )
G01 F20
X2.0500 Y-0.0500
X2.0500 Y1.0500
X-0.0500 Y1.0500
X-0.0500 Y-0.0500
G00 Z0.1
M9 ( Coolant off. )
M5 ( Spindle off. )
M2 ( Program end. )
