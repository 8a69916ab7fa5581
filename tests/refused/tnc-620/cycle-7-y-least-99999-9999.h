; 4:14 alarm: CYCL DEF 7 Y (datum shift along Y) must be at least -99999.9999 and at most 99999.9999, got -100000
TOOL CALL 1 Z S1000 F100
CYCL DEF 7.0 S
CYCL DEF 7.1 Y-100000
