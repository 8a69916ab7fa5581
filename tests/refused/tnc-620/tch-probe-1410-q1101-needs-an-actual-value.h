; 6:1 alarm: TCH PROBE 1410 Q1101 (first point, minor axis) needs an actual value (@) as the others of the point: it has all three, or none
1 TOOL CALL 6 Z
2 L Z+100 R0 FMAX
3 TCH PROBE 1410 NAME
QS1100="10@10.1"
Q1101=0
Q1102=-5
Q1103=90
Q1104=0
Q1105=-5
Q372=2
Q320=0
Q260=20
Q1125=1
Q309=0
Q1126=0
Q1120=0
Q1121=0
