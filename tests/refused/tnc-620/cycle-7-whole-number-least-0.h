; 4:14 alarm: CYCL DEF 7 # (row of the datum table) must be a whole number and at least 0 and at most 9999, got 10000
TOOL CALL 1 Z S1000 F100
CYCL DEF 7.0 S
CYCL DEF 7.1 #10000
