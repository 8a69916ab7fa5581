; 4:15 alarm: CYCL DEF 13 ANGLE (angle of the spindle) must be at least 0 and at most 360, got 361
TOOL CALL 1 Z S200 F100
CYCL DEF 13.0 O
CYCL DEF 13.1 UNGHI 361
