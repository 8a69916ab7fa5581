; 3:1 alarm: CYCL DEF 19 F (feed of the rotary axes) is missing: to position the rotary axes both F and ABST are needed
TOOL CALL 1 Z S1000 F100
CYCL DEF 19.0 P
CYCL DEF 19.1 A+1 ABST5
