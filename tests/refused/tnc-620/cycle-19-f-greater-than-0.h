; 4:19 alarm: CYCL DEF 19 F (feed of the rotary axes) must be greater than 0 to position the rotary axes, got 0
TOOL CALL 1 Z S1000 F100
CYCL DEF 19.0 P
CYCL DEF 19.1 A+1 F0 ABST5
