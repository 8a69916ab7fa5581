; 5:15 alarm: CYCL DEF 18 PITCH (pitch of the thread) must be at most 99999.9999 either way and not 0, got 0
TOOL CALL 1 Z S200 F100
CYCL DEF 18.0 T
CYCL DEF 18.1 DEPTH -5
CYCL DEF 18.2 PITCH 0
CYCL CALL
