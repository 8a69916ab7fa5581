; 3:1 alarm: CYCL DEF 9 DWELL (dwell) is missing
TOOL CALL 1 Z S200 F100
CYCL DEF 9.0 D
