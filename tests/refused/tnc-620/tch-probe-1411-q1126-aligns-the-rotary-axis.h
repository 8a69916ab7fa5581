; 21:1 alarm: TCH PROBE 1411 Q1126 (how rotary axes are aligned) aligns the rotary axis: then Q1121 must be 2, and no basic rotation takes the angle over
1 TOOL CALL 6 Z
2 L Z+100 R0 FMAX
3 TCH PROBE 1411 NAME
Q1100=10
Q1101=0
Q1102=-5
Q1103=90
Q1104=0
Q1105=-5
Q1116=20
Q1117=20
Q1115=0
Q423=4
Q325=0
Q1119=360
Q320=0
Q260=20
Q1125=1
Q309=0
Q1126=1
Q1120=0
Q1121=1
