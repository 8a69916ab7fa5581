; 4:15 alarm: CYCL DEF 32 T (permissible contour deviation) must be at least 0 and at most 10, got 10.1
TOOL CALL 1 Z S200 F100
CYCL DEF 32.0 T
CYCL DEF 32.1 T10.1
