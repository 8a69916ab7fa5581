; 4:15 alarm: CYCL DEF 18 DEPTH (depth of the thread from where the tool stands) must be at least -99999 and at most 99999, got -100000
TOOL CALL 1 Z S200 F100
CYCL DEF 18.0 T
CYCL DEF 18.1 DEPTH -100000
CYCL DEF 18.2 PITCH 1
