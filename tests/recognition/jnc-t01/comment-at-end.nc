G90 F100 ' absolute
G01 X40.
Z-12.5
