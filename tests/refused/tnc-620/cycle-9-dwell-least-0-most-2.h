; 4:14 alarm: CYCL DEF 9 DWELL (dwell) must be at least 0 and at most 3600, got -1
TOOL CALL 1 Z S200 F100
CYCL DEF 9.0 D
CYCL DEF 9.1 TEMP -1
