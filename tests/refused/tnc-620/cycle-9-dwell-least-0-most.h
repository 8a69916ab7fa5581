; 4:14 alarm: CYCL DEF 9 DWELL (dwell) must be at least 0 and at most 3600, got 3601
TOOL CALL 1 Z S200 F100
CYCL DEF 9.0 D
CYCL DEF 9.1 DWELL 3601
