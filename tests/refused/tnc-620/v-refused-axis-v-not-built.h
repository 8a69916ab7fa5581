; 4:14 alarm: V is refused: the secondary axis V is built for L alone
TOOL CALL 1 Z S1000 F100
CYCL DEF 7.0 S
CYCL DEF 7.1 V+1
