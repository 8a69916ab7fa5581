;PycamVersion=0.6
;Start_X=0
G40 ; disable tool radius compensation
G49 ; disable tool length compensation
G80 ; cancel modal motion
G54 ; select coordinate system 1
G90 ; use absolute coordinates
G21 ; metric
G61 ; exact path mode
F300.00000
S1000.00000
T1 M6
M3
G04 P3
G0 Z5.0000
G0 X-1.0000 Y-1.0000
G1 Z-1.0000
X21.0000
Y0.5000
X-1.0000
Y2.0000
X21.0000
G0 Z5.0000
M5
M2
