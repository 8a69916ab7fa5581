; 4:15 alarm: CYCL DEF 19 A (tilt angle A) must be at least -360 and at most 360, got 361
TOOL CALL 1 Z S1000 F100
CYCL DEF 19.0 P
CYCL DEF 19.1 A+361
