; 4:15 alarm: CYCL DEF 26 takes no incremental value, got IX
TOOL CALL 1 Z S1000 F100
CYCL DEF 26.0 S
CYCL DEF 26.1 IX 2
