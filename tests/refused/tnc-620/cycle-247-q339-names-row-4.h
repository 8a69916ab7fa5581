; 4:1 alarm: CYCL DEF 247 Q339 (number of the preset) names row 4, which the preset table does not have (rows: none but 0)
TOOL CALL 1 Z S1000 F100
CYCL DEF 247 P
Q339=4
