; 5:14 alarm: CYCL DEF 7 # (row of the datum table) and shifts of axes cannot stand in one definition
TOOL CALL 1 Z S1000 F100
CYCL DEF 7.0 S
CYCL DEF 7.1 X+1
CYCL DEF 7.2 #5
