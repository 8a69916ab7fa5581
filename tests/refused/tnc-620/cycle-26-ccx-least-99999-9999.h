; 4:19 alarm: CYCL DEF 26 CCX (centre of the scaling along X) must be at least -99999.9999 and at most 99999.9999, got 100000
TOOL CALL 1 Z S1000 F100
CYCL DEF 26.0 S
CYCL DEF 26.1 X 2 CCX+100000
