; 4:15 alarm: CYCL DEF 19 takes no incremental value, got IA
TOOL CALL 1 Z S1000 F100
CYCL DEF 19.0 P
CYCL DEF 19.1 IA+1
