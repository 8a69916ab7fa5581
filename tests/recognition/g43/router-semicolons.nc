; sign board, 3 mm cutter
G21 ; millimetres
G90 ; absolute
M3 S16000
G0 Z5
G0 X12.5 Y8
G1 Z-1.2 F250
G1 X88.5 F1400
G1 Y40
G0 Z5
M5
M2
