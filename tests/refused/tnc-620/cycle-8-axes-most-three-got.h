; 4:14 alarm: CYCL DEF 8 axes (mirrored axes) must be at most three, got X Y A B
TOOL CALL 1 Z S1000 F100
CYCL DEF 8.0 M
CYCL DEF 8.1 X Y A B
