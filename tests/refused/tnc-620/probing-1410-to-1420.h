; -- cycle-1410
1 TOOL CALL 6 Z
2 L Z+100 R0 FMAX
3 TCH PROBE 1410 NAME
Q1100=10
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

; == tch-probe-1410-actual-value-alone like cycle-1410
; 7:1 alarm: TCH PROBE 1410 Q1102 (first point, tool axis) needs a nominal value, got "@5"
@@ 7
-Q1102=-5
+QS1102="@5"

; == tch-probe-1410-no-nominal-value like cycle-1410
; 6:1 alarm: TCH PROBE 1410 Q1101 (first point, minor axis) is no nominal value such as "?10", "10+0.02-0.01" or "10@10.01", got "ten"
@@ 6
-Q1101=0
+QS1101="ten"

; == tch-probe-1410-q1101-needs-an-actual-value like cycle-1410
; 6:1 alarm: TCH PROBE 1410 Q1101 (first point, minor axis) needs an actual value (@) as the others of the point: it has all three, or none
@@ 5
-Q1100=10
+QS1100="10@10.1"

; == tch-probe-1410-q1103-and-the-minor-axis like cycle-1410
; 8:1 alarm: TCH PROBE 1410 Q1103 (second point, reference axis) and the minor axis give the first place again: two places make a line
@@ 8
-Q1103=90
+Q1103=10

; == tch-probe-1410-q1126-aligns-the-rotary-axis like cycle-1410
; 16:1 alarm: TCH PROBE 1410 Q1126 (how rotary axes are aligned) aligns the rotary axis: then Q1121 must be 2, and no basic rotation takes the angle over
@@ 16
-Q1126=0
+Q1126=1
@@ 18
-Q1121=0
+Q1121=1

; == tch-probe-1410-q372-must-be-one-of like cycle-1410
; 11:1 alarm: TCH PROBE 1410 Q372 (probing direction) must be one of 1, -1, 2, -2, 3, -3, got 0
@@ 11
-Q372=2
+Q372=0

; == tch-probe-1410-three-tolerances like cycle-1410
; 5:1 alarm: TCH PROBE 1410 Q1100 (first point, reference axis) takes 2 tolerances at most, got "10+1+2+3"
@@ 5
-Q1100=10
+QS1100="10+1+2+3"

; -- cycle-1411
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
Q1126=0
Q1120=0
Q1121=0

; == tch-probe-1411-diameter-asked-for like cycle-1411
; 12:1 alarm: TCH PROBE 1411 Q1117 (second diameter) must be a diameter of 0 or more, to know where the touches begin
@@ 12
-Q1117=20
+QS1117="?"

; == tch-probe-1411-diameter-known-center-not like cycle-1411
; 11:1 alarm: TCH PROBE 1411 Q1116 (first diameter) and its center must both have an actual value (@), or none
@@ 11
-Q1116=20
+QS1116="20@20.1"

; == tch-probe-1411-q1103-and-the-minor-axis like cycle-1411
; 8:1 alarm: TCH PROBE 1411 Q1103 (second center, reference axis) and the minor axis give the first place again: two places make a line
@@ 8
-Q1103=90
+Q1103=10

; == tch-probe-1411-q1116-must-be-at-least like cycle-1411
; 11:1 alarm: TCH PROBE 1411 Q1116 (first diameter) must be at least the diameter of the ball, 4, got 3.9
@@ 11
-Q1116=20
+Q1116=3.9

; == tch-probe-1411-q1119-must-be-at-least like cycle-1411
; 16:1 alarm: TCH PROBE 1411 Q1119 (angle over which the touches are spread) must be at least -359.999 and at most 360, got -360
@@ 16
-Q1119=360
+Q1119=-360

; == tch-probe-1411-q1119-must-not-be-0 like cycle-1411
; 16:1 alarm: TCH PROBE 1411 Q1119 (angle over which the touches are spread) must not be 0: the touches would be one
@@ 16
-Q1119=360
+Q1119=0

; == tch-probe-1411-q1126-aligns-the-rotary-axis
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

; == tch-probe-1411-q423-must-be-a-whole like cycle-1411
; 14:1 alarm: TCH PROBE 1411 Q423 (number of touches) must be a whole number and at least 3 and at most 8, got 2
@@ 14
-Q423=4
+Q423=2

; -- cycle-1420
1 TOOL CALL 6 Z
2 L Z+100 R0 FMAX
3 TCH PROBE 1420 NAME
Q1100=10
Q1101=10
Q1102=0
Q1103=80
Q1104=10
Q1105=0
Q1106=10
Q1107=50
Q1108=0
Q372=-3
Q320=0
Q260=20
Q1125=1
Q309=0
Q1126=0
Q1120=0
Q1121=0

; == tch-probe-1420-q1106-makes-no-plane-with like cycle-1420
; 11:1 alarm: TCH PROBE 1420 Q1106 (third point, reference axis) makes no plane with the other points: the points lie on one line, so that any plane through it holds them
@@ 11
-Q1106=10
-Q1107=50
+Q1106=30
+Q1107=10

; == tch-probe-1420-q1106-needs-an-actual-value like cycle-1420
; 11:1 alarm: TCH PROBE 1420 Q1106 (third point, reference axis) needs an actual value (@) as the others of the point: it has all three, or none
@@ 12
-Q1107=50
+QS1107="50@50.1"

; == tch-probe-1420-q1126-aligns-the-rotary-axes like cycle-1420
; 19:1 alarm: TCH PROBE 1420 Q1126 (how rotary axes are aligned) aligns the rotary axes: then Q1121 must be 1, which takes the rotation over
@@ 19
-Q1126=0
+Q1126=1
