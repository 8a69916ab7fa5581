; 3:1 alarm: CYCL DEF 26 needs an axis and its factor, for example CYCL DEF 26.1 X 1.4 Y 0.6
TOOL CALL 1 Z S1000 F100
CYCL DEF 26.0 S
CYCL DEF 26.1 CCX+1
