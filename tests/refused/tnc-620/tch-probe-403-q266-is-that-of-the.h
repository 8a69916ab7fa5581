; 8:1 alarm: TCH PROBE 403 Q266 (second touch point, minor axis) is that of the first touch point: two places make a line
1 TOOL CALL 6 Z
2 L Z+100 R0 FMAX
3 TCH PROBE 403 NAME
Q263=10
Q264=0
Q265=90
Q266=0
Q272=3
Q267=1
Q261=-5
Q320=0
Q260=20
Q301=0
Q312=4
Q337=1
Q305=3
Q303=1
Q380=0
