; 4:15 alarm: only letters of axes stand here, for example X Y
TOOL CALL 1 Z S1000 F100
CYCL DEF 8.0 M
CYCL DEF 8.1 X+5
