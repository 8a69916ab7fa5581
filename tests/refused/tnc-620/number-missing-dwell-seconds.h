; 4:14 alarm: a number is missing: the dwell in seconds
TOOL CALL 1 Z S200 F100
CYCL DEF 9.0 D
CYCL DEF 9.1 TEMP
