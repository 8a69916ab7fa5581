; -- wall
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S2000 F400
2 L X+0 Y+0 Z+100 R0 FMAX
5 CYCL DEF 14.0 CONTOUR
6 CYCL DEF 14.1 CONTOUR LABEL 1
7 CYCL DEF 276 TRAIN
  Q1=-10
  Q3=0
  Q7=50
  Q10=5
  Q11=100
  Q12=350
  Q15=1
  Q18=0
  Q446=0.01
  Q447=10
  Q448=2
8 CYCL CALL M3
9 M30
10 LBL 1
L X+0 Y+0 Z+0 RL
L X+40
11 LBL 0
12 END PGM A MM

; == contour-above-height like wall
; 23:1 alarm: CYCL DEF 276: the contour reaches up to Z60 here, above the clearance height 50
@@ 22
-L X+0 Y+0 Z+0 RL
+L X+0 Y+0 Z+60 RL

; == first-block-without-z like wall
; 22:1 alarm: the contour of label 1 must begin with X, Y and Z
@@ 22
-L X+0 Y+0 Z+0 RL
-L X+40
+L X+0 Y+0 RL
+L X+40 Z-5

; == label-moves-only-upright like wall
; 23:1 alarm: the contour of label 1 has no length in the plane XY
@@ 23
-L X+40
+L Z-5

; == step-too-short-for-tool like wall
; 24:1 alarm: the element is too short for the tool radius 5: the offsets of its neighbours do not meet on it: 2 mm are missing, the largest radius for the whole contour is 3 mm (take a smaller tool, or lengthen the element)
@@ 23
-L X+40
+L X+40 Z-1
+L Y+3
+L X+48
+L Y+0
+L X+80

; == tool-below-height like wall
; 10:3 alarm: CYCL DEF 276 Q7 (clearance height) lies above the tool, which stands at Z20, got 50
@@ 4
-2 L X+0 Y+0 Z+100 R0 FMAX
+2 L X+0 Y+0 Z+20 R0 FMAX

; == two-labels like wall
; 19:1 alarm: CYCL DEF 276 takes a single contour, but CYCL DEF 14 names 2 labels
@@ 6
-6 CYCL DEF 14.1 CONTOUR LABEL 1
+6 CYCL DEF 14.1 CONTOUR LABEL 1/2
@@ 25
+LBL 2
+L X+0 Y+0 RL
+L X+5
+LBL 0
