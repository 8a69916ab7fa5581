; 7:1 alarm: TCH PROBE 401 Q270 (second center, reference axis) and Q271 are those of the first center: two places make a line
1 TOOL CALL 6 Z
2 L Z+100 R0 FMAX
3 TCH PROBE 401 NAME
Q268=10
Q269=-5
Q270=10
Q271=-5
Q261=-5
Q260=20
Q307=0
Q305=0
Q402=0
Q337=0
