(the same square, turned by 30 degrees about the corner of G55)
G21 G17 G90 G94 G40 G49 G80 G54
F300
G10 L2 P2 X50 Y20 Z0 R30
G0 X0 Y0 Z5
G55
G0 X0 Y0
G1 X10
Y10
X0
Y0
G54 G0 X0 Y0
M2
