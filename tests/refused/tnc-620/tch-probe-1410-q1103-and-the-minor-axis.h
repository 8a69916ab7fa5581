; 8:1 alarm: TCH PROBE 1410 Q1103 (second point, reference axis) and the minor axis give the first place again: two places make a line
1 TOOL CALL 6 Z
2 L Z+100 R0 FMAX
3 TCH PROBE 1410 NAME
Q1100=10
Q1101=0
Q1102=-5
Q1103=10
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
