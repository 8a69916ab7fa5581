; 11:1 alarm: TCH PROBE 1420 Q1106 (third point, reference axis) makes no plane with the other points: the points lie on one line, so that any plane through it holds them
1 TOOL CALL 6 Z
2 L Z+100 R0 FMAX
3 TCH PROBE 1420 NAME
Q1100=10
Q1101=10
Q1102=0
Q1103=80
Q1104=10
Q1105=0
Q1106=30
Q1107=10
Q1108=0
Q372=-3
Q320=0
Q260=20
Q1125=1
Q309=0
Q1126=0
Q1120=0
Q1121=0
