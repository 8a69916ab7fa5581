; 3:1 alarm: CYCL DEF 247 Q339 (number of the preset) is missing
TOOL CALL 1 Z S1000 F100
CYCL DEF 247 P
