; 4:15 alarm: CYCL DEF 11 SCL (scaling factor) must be at least 1e-06 and at most 99.999999, got 100
TOOL CALL 1 Z S1000 F100
CYCL DEF 11.0 S
CYCL DEF 11.1 SCL 100
