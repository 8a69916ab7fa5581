; 4:15 alarm: CYCL DEF 26 X (factor along X) must be at least 1e-06 and at most 99.999999, got 0
TOOL CALL 1 Z S1000 F100
CYCL DEF 26.0 S
CYCL DEF 26.1 X 0 Y 1
