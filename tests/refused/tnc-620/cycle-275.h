; -- slot
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L Z+50 R0 FMAX M3
3 CYCL DEF 14.0 C
4 CYCL DEF 14.1 CONTOUR LABEL1
5 CYCL DEF 275 T
Q215=0
Q219=14
Q368=0.2
Q436=2
Q207=500
Q351=1
Q201=-20
Q202=5
Q206=150
Q338=5
Q385=500
Q200=2
Q203=0
Q204=50
Q366=0
Q369=0
Q439=0
6 CYCL CALL M3
7 L Z+50 FMAX M2
8 LBL 1
9 L X+10 Y+10
10 L X+40
11 LBL 0
12 END PGM A MM

; == allowance-for-floor-is-the-depth like slot
; 23:1 alarm: CYCL DEF 275 Q369 (finishing allowance for floor) must be less than the depth 20, got 20
@@ 23
-Q369=0
+Q369=20

; == allowance-too-large like slot
; 9:1 alarm: CYCL DEF 275 Q219 (slot width) must be at least the tool diameter and twice Q368, 19, got 14
@@ 10
-Q368=0.2
+Q368=4.5

; == approach-begins-inside-its-arc like slot
; 29:1 alarm: APPR LCT begins inside of its arc of R8: no line touches the arc from there (take a smaller radius, or a point farther away)
@@ 28
-9 L X+10 Y+10
-10 L X+40
+9 L X+12 Y+11
+10 APPR LCT X+10 Y+10 R8 RL
+11 L X+40

; == begins-in-a-corner like slot
; 29:1 alarm: CYCL DEF 275: a slot must not begin in a corner of its contour
@@ 30
+11 L Y+40
+12 L X+10
+13 L Y+10

; == contour-has-a-fault-in-an-arc like slot
; 30:1 alarm: the end point is not on the circle: radius 20.0000 at the start, 20.0250 at the end, allowed difference 0.016 mm
@@ 29
-10 L X+40
+10 CC X+30 Y+10
+11 C X+50 Y+11 DR+

; == contour-has-a-fault like slot
; 30:1 alarm: a rounding of R50 does not fit between its elements, which are too short for it
@@ 30
+11 RND R50
+12 L Y+20

; == contour-is-a-point like slot
; 28:1 alarm: label 1 describes no contour
@@ 29
-10 L X+40

; == contour-leaves-the-plane like slot
; 29:1 alarm: the contour of label 1 moves along the tool axis
@@ 29
-10 L X+40
+10 L X+40 Z-1

; == depth-positive like slot
; 14:1 alarm: CYCL DEF 275 Q201 (depth) must be negative, got 20: a positive depth works upwards
@@ 14
-Q201=-20
+Q201=20

; == edge-feed-at-tight-bend like slot
; 25:1 alarm: CYCL DEF 275 Q439=3 cannot be obeyed: the wall has no radius where a tool of radius 5 goes round it at 1.2 (Q439=0 counts at the tool centre)
@@ 9
-Q219=14
+Q219=18
@@ 24
-Q439=0
+Q439=3
@@ 30
+11 RND R5
+12 L Y-20

; == finishing-feed-0 like slot
; 18:1 alarm: CYCL DEF 275 Q385 (finishing feed rate) must be greater than 0 to mill with, got 0
@@ 18
-Q385=500
+Q385=0

; == has-no-q370 like slot
; 25:1 alarm: Q370=1 has no meaning in this block (CYCL DEF 275 does not take Q370) (a line Q… without a block number belongs to the definition above it: number it to assign a variable)
@@ 25
+Q370=1

; == infeed-0 like slot
; 15:1 alarm: CYCL DEF 275 Q202 (infeed depth) must be greater than 0, got 0
@@ 15
-Q202=5
+Q202=0

; == milling-feed-0 like slot
; 12:1 alarm: CYCL DEF 275 Q207 (feed rate for milling) must be greater than 0 to mill with, got 0
@@ 12
-Q207=500
+Q207=0

; == narrower-than-the-tool like slot
; 9:1 alarm: CYCL DEF 275 Q219 (slot width) must be at least the tool diameter, 10, got 3
@@ 9
-Q219=14
+Q219=3

; == needs-contour like slot
; 23:1 alarm: CYCL DEF 275 needs a contour: CYCL DEF 14 comes before it
@@ 5
-3 CYCL DEF 14.0 C
-4 CYCL DEF 14.1 CONTOUR LABEL1

; == plunging-strategy-3 like slot
; 22:1 alarm: CYCL DEF 275 Q366 (plunging strategy) must be one of 0, 1, 2, got 3
@@ 22
-Q366=0
+Q366=3

; == step-0 like slot
; 11:1 alarm: CYCL DEF 275 Q436 (infeed per revolution) must be greater than 0 to advance by, got 0
@@ 11
-Q436=2
+Q436=0

; == step-larger-than-the-tool like slot
; 11:1 alarm: CYCL DEF 275 Q436 (infeed per revolution) must be at most the tool diameter, 10, got 101
@@ 11
-Q436=2
+Q436=101

; == takes-single-contour like slot
; 25:1 alarm: CYCL DEF 275 takes a single contour, but CYCL DEF 14 names 2 labels
@@ 6
-4 CYCL DEF 14.1 CONTOUR LABEL1
+4 CYCL DEF 14.1 CONTOUR LABEL1/2
@@ 31
+ LBL 2
+ L X+0 Y+0
+ L X+5
+ LBL 0

; == too-many-circles like slot
; 7:1 alarm: CYCL DEF 275 a step of 0.0004 divides the slot into more than 20000 circles
@@ 11
-Q436=2
+Q436=0.0004

; == too-many-levels like slot
; 25:1 alarm: CYCL DEF 275 Q436 (infeed per revolution) makes 400 levels of 301 passes, more than 5000 together
@@ 11
-Q436=2
+Q436=0.1
@@ 15
-Q202=5
+Q202=0.05

; == wider-than-twice-the-tool like slot
; 9:1 alarm: CYCL DEF 275 Q219 (slot width) must be at most twice the tool diameter, 20, got 200
@@ 9
-Q219=14
+Q219=200
