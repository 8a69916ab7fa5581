; 3:1 alarm: CYCL DEF 239 Q570 (what to do) is missing
TOOL CALL 1 Z S200 F100
CYCL DEF 239 L
