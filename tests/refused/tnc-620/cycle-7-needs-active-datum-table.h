; 4:14 alarm: CYCL DEF 7 # (row of the datum table) needs an active datum table: write SEL TABLE before, or give Setup(datums=…)
TOOL CALL 1 Z S1000 F100
CYCL DEF 7.0 S
CYCL DEF 7.1 #5
