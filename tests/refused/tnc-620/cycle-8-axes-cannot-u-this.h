; 4:14 alarm: CYCL DEF 8 axes (mirrored axes) cannot be U: this axis is not built yet
TOOL CALL 1 Z S1000 F100
CYCL DEF 8.0 M
CYCL DEF 8.1 U
