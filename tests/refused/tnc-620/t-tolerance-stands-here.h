; 4:15 alarm: T, the tolerance, stands here
TOOL CALL 1 Z S200 F100
CYCL DEF 32.0 T
CYCL DEF 32.1 X1
