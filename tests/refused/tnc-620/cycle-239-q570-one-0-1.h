; 4:1 alarm: CYCL DEF 239 Q570 (what to do) must be one of 0, 1, got 2
TOOL CALL 1 Z S200 F100
CYCL DEF 239 L
Q570=2
