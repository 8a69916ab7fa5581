; 7:1 alarm: CYCL DEF 18 needs a spindle that stands still: it would stop it and cut with no rotation; write M5 before
TOOL CALL 1 Z S200 F100
CYCL DEF 18.0 T
CYCL DEF 18.1 DEPTH -5
CYCL DEF 18.2 PITCH 1
L X1 M3
CYCL CALL
