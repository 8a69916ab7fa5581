; 6:1 alarm: TCH PROBE 404 Q305 (number in table) must be a whole number and at least -1 and at most 99999, got -2
1 TOOL CALL 6 Z
2 L Z+100 R0 FMAX
3 TCH PROBE 404 NAME
Q307=1
Q305=-2
