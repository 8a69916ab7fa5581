; == tch-probe-400-q265-is-that-of-the
; 7:1 alarm: TCH PROBE 400 Q265 (second touch point, reference axis) is that of the first touch point: two places make a line
1 TOOL CALL 6 Z
2 L Z+100 R0 FMAX
3 TCH PROBE 400 NAME
Q263=10
Q264=0
Q265=10
Q266=0
Q272=2
Q267=1
Q261=-5
Q320=0
Q260=20
Q301=0
Q307=0
Q305=3

; == tch-probe-400-q266-is-that-of-the
; 8:1 alarm: TCH PROBE 400 Q266 (second touch point, minor axis) is that of the first touch point: two places make a line
1 TOOL CALL 6 Z
2 L Z+100 R0 FMAX
3 TCH PROBE 400 NAME
Q263=10
Q264=0
Q265=90
Q266=0
Q272=1
Q267=1
Q261=-5
Q320=0
Q260=20
Q301=0
Q307=0
Q305=3

; == tch-probe-401-q270-and-q271-are-those
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

; == tch-probe-402-q270-and-q271-are-those
; 7:1 alarm: TCH PROBE 402 Q270 (second center, reference axis) and Q271 are those of the first center: two places make a line
1 TOOL CALL 6 Z
2 L Z+100 R0 FMAX
3 TCH PROBE 402 NAME
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
Q313=31
Q314=31
Q315=-6
Q320=0
Q301=0

; -- cycle-403
1 TOOL CALL 6 Z
2 L Z+100 R0 FMAX
3 TCH PROBE 403 NAME
Q263=10
Q264=0
Q265=90
Q266=0
Q272=2
Q267=1
Q261=-5
Q320=0
Q260=20
Q301=0
Q312=6
Q337=1
Q305=3
Q303=1
Q380=0

; == tch-probe-403-q265-is-that-of-the like cycle-403
; 7:1 alarm: TCH PROBE 403 Q265 (second touch point, reference axis) is that of the first touch point: two places make a line
@@ 7
-Q265=90
+Q265=10

; == tch-probe-403-q266-is-that-of-the like cycle-403
; 8:1 alarm: TCH PROBE 403 Q266 (second touch point, minor axis) is that of the first touch point: two places make a line
@@ 9
-Q272=2
+Q272=3
@@ 15
-Q312=6
+Q312=4

; == tch-probe-403-q312-0-the-touch-points like cycle-403
; 15:1 alarm: TCH PROBE 403 Q312 (rotary axis) 0: the touch points lie apart in both axes: choose 4 (A) or 5 (B)
@@ 8
-Q266=0
-Q272=2
+Q266=5
+Q272=3
@@ 15
-Q312=6
+Q312=0

; == tch-probe-403-q312-a-is-not-shown like cycle-403
; 15:1 alarm: TCH PROBE 403 Q312 (rotary axis) A is not shown by touches along the minor axis
@@ 15
-Q312=6
+Q312=4

; == tch-probe-403-q312-c-is-not-shown like cycle-403
; 15:1 alarm: TCH PROBE 403 Q312 (rotary axis) C is not shown by touches along the touch probe axis
@@ 9
-Q272=2
+Q272=3

; == tch-probe-403-q312-must-be-one-of like cycle-403
; 15:1 alarm: TCH PROBE 403 Q312 (rotary axis) must be one of 0, 4, 5, 6, got 1
@@ 15
-Q312=6
+Q312=1

; == tch-probe-403-q312-needs-the-rotary-axis like cycle-403
; 15:1 alarm: TCH PROBE 403 Q312 (rotary axis) needs the rotary axis B: the machine has A and C (setting rotary_axes)
@@ 9
-Q272=2
+Q272=3
@@ 15
-Q312=6
+Q312=5

; == tch-probe-404-q305-must-be-a-whole
; 6:1 alarm: TCH PROBE 404 Q305 (number in table) must be a whole number and at least -1 and at most 99999, got -2
1 TOOL CALL 6 Z
2 L Z+100 R0 FMAX
3 TCH PROBE 404 NAME
Q307=1
Q305=-2

; == tch-probe-405-q247-must-be-at-least
; 9:1 alarm: TCH PROBE 405 Q247 (stepping angle) must be at least 5 or at most -5, got 4.9
1 TOOL CALL 6 Z
2 L Z+100 R0 FMAX
3 TCH PROBE 405 NAME
Q321=50
Q322=50
Q262=10
Q325=0
Q247=4.9
Q261=-5
Q320=0
Q260=20
Q301=0
Q337=0
