; 4:1 alarm: CYCL DEF 247 Q339 (number of the preset) must be a whole number and at least 0 and at most 65535, got 65536
TOOL CALL 1 Z S1000 F100
CYCL DEF 247 P
Q339=65536
