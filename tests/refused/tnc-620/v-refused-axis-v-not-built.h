; 4:14 alarm: V is refused: the axis V is not built yet
TOOL CALL 1 Z S1000 F100
CYCL DEF 7.0 S
CYCL DEF 7.1 V+1
