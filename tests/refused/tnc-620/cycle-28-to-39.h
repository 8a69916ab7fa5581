; -- slot
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F200
2 M3
3 CYCL DEF 14.0 CONTOUR
4 CYCL DEF 14.1 CONTOUR LABEL 1
5 CYCL DEF 28 CYLINDER
  Q1=-5
  Q3=+0
  Q6=20
  Q10=+5
  Q11=100
  Q12=200
  Q16=+40
  Q17=1
  Q20=+20
6 L X+0 Y+0 Z+100 R0 FMAX M99
7 M2
8 LBL 1
L X+0 Y+0 RL
L X+50
9 LBL 0
99 END PGM A MM

; == cycle-28-contour-narrow-arc-degrees like slot
; 24:1 alarm: CYCL DEF 28: the inside arc of radius 3 is not greater than the distance 5: 2 mm are missing, the largest distance for the whole contour is 3 mm (take a smaller tool)
@@ 15
-  Q17=1
+  Q17=0
@@ 17
+  Q21=+0
@@ 23
+RND R3
+L Y+50

; == cycle-28-q12-not-0 like slot
; 13:3 alarm: CYCL DEF 28 Q12 (feed rate for roughing) must be greater than 0, got 0
@@ 13
-  Q12=200
+  Q12=0
@@ 17
+  Q21=+0

; == cycle-28-q21-at-least like slot
; 17:3 alarm: CYCL DEF 28 Q21 (tolerance) must be 0 or at least 0.0001, got 1e-05
@@ 17
+  Q21=+0.00001

; == cycle-28-q3-slot-too-narrow like slot
; 16:3 alarm: CYCL DEF 28 Q20 (slot width) less Q3 on both walls is 8, too narrow for the tool diameter 10
@@ 9
-  Q3=+0
+  Q3=+6
@@ 17
+  Q21=+0

; == cycle-28-slot-too-narrow like slot
; 16:3 alarm: CYCL DEF 28 Q20 (slot width) less Q3 on both walls is 9, too narrow for the tool diameter 10
@@ 16
-  Q20=+20
+  Q20=+9
+  Q21=+0

; == cycle-28-spindle like slot
; 18:1 alarm: CYCL DEF 28 needs a turning spindle (setting spindle_error)
@@ 4
-2 M3
+2 L FMAX
@@ 17
+  Q21=+0

; == cycle-29-closed like slot
; 23:1 alarm: CYCL DEF 29: the midpoint path closes: a ridge has two ends, whose half circles would cut it (let it end at least half the ridge width before its begin)
@@ 7
-5 CYCL DEF 28 CYLINDER
+5 CYCL DEF 29 CYLINDER
@@ 22
+L Y+50
+L X+0 Y+0

; == cycle-29-no-room-to-approach like slot
; 9:3 alarm: CYCL DEF 29 Q3 (finishing allowance for side) must be less than the tool radius 5, got 5: no room to approach
@@ 7
-5 CYCL DEF 28 CYLINDER
+5 CYCL DEF 29 CYLINDER
@@ 9
-  Q3=+0
+  Q3=+5

; == cycle-29-without-side like slot
; 17:1 alarm: CYCL DEF 29: the contour has no RL or RR, which says on which side the tool is
@@ 7
-5 CYCL DEF 28 CYLINDER
+5 CYCL DEF 29 CYLINDER
@@ 20
-L X+0 Y+0 RL
+L X+0 Y+0 R0

; == cycle-39-mirror-across like slot
; 18:1 alarm: CYCL DEF 39 cannot run under a mirror image across the cylinder alone: the axis A must be mirrored, too
@@ 5
+2 CYCL DEF 8.0 X
+2 CYCL DEF 8.1 Y
@@ 9
-5 CYCL DEF 28 CYLINDER
+5 CYCL DEF 39 CYLINDER
@@ 18
-  Q20=+20

; == cycle-39-without-side like slot
; 16:1 alarm: CYCL DEF 39: the contour has no RL or RR, which says on which side the tool is
@@ 7
-5 CYCL DEF 28 CYLINDER
+5 CYCL DEF 39 CYLINDER
@@ 16
-  Q20=+20
@@ 19
-L X+0 Y+0 RL
+L X+0 Y+0
