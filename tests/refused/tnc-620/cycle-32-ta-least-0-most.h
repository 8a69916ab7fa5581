; 5:15 alarm: CYCL DEF 32 TA (permissible deviation of rotary axes) must be at least 0 and at most 10, got -1
TOOL CALL 1 Z S200 F100
CYCL DEF 32.0 T
CYCL DEF 32.1 T1
CYCL DEF 32.2 TA-1
