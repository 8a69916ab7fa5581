; -- corner
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S2000 F400
2 L X+0 Y+0 Z+100 R0 FMAX
5 CYCL DEF 14.0 CONTOUR
6 CYCL DEF 14.1 CONTOUR LABEL 1
7 CYCL DEF 25 TRAIN
  Q1=-10
  Q3=0
  Q5=0
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
L X+10 Y+10 RL
L X+50
L Y+50
11 LBL 0
12 END PGM A MM

; == appr-amid-contour like corner
; 25:1 alarm: APPR LT must begin the contour of label 1 (the block with its starting point may stand before it, nothing else)
@@ 23
-L X+10 Y+10 RL
-L X+50
-L Y+50
+L X+0 Y+0 RL
+L X+20
+APPR LT X+40 Y+0 LEN8 RL
+L X+60

; == appr-into-contour like corner
; 24:1 alarm: the approach leads the tool into the contour at X6.632 Y12.491 (take another approach, a smaller radius or a shorter distance)
@@ 23
-L X+10 Y+10 RL
+L X-10 Y-10 R0
+APPR LCT X+10 Y+10 R3 RL
@@ 26
-L Y+50

; == approach-into-contour like corner
; 26:1 alarm: the approach leads the tool into the contour at X10.000 Y15.000 (take another approach, a smaller radius or a shorter distance)
@@ 7
+CYCL DEF 270 DATA
+ Q390=2
+ Q391=1
+ Q392=3
+ Q393=45
+ Q394=5
@@ 29
-L X+10 Y+10 RL
+L X+10 Y+10
@@ 32
+L X+10
+L Y+10

; == block-behind-dep like corner
; 26:1 alarm: the contour of label 1 ends with DEP LT, this block stands behind it
@@ 23
-L X+10 Y+10 RL
-L X+50
-L Y+50
+L X+0 Y+0 RL
+L X+20
+DEP LT LEN5
+L X+60

; == changes-side like corner
; 25:1 alarm: the contour of label 1 changes from RL to RR or back in this block
@@ 23
-L X+10 Y+10 RL
-L X+50
-L Y+50
+L X+0 Y+0 RL
+L X+40
+L Y+40 RR

; == coarse-tool-missing like corner
; 19:3 alarm: CYCL DEF 25 Q18 (coarse roughing tool) names tool "GROB", which has no row in the tool table
@@ 16
-  Q18=0
@@ 19
+  QS18="GROB"

; == coarse-tool-no-larger like corner
; 16:3 alarm: CYCL DEF 25 Q18 (coarse roughing tool) must be larger than the tool, whose radius is 5, got 5
@@ 16
-  Q18=0
+  Q18=1

; == compensation-ends like corner
; 25:1 alarm: the contour of label 1 changes its radius compensation in this block
@@ 23
-L X+10 Y+10 RL
-L X+50
-L Y+50
+L X+0 Y+0 RL
+L X+40
+L Y+40 R0

; == begins-with-an-arc like corner
; 23:1 alarm: the arc has no start: nothing before it in the contour names both coordinates (begin with a line)
@@ 23
-L X+10 Y+10 RL
+CR X+75 Y+56 R+18 DR+

; == half-a-start like corner
; 24:1 alarm: the arc has no start: nothing before it in the contour names both coordinates (begin with a line)
@@ 23
-L X+10 Y+10 RL
-L X+50
+L X+10 RL
+CR X+75 Y+56 R+48 DR+

; == contour-crosses-itself like corner
; 27:1 alarm: the contour crosses itself
@@ 23
-L X+10 Y+10 RL
-L X+50
-L Y+50
+L X+0 Y+0 RL
+L X+40
+L Y+40
+L X+20
+L Y-20

; == feed-0 like corner
; 14:3 alarm: CYCL DEF 25 Q12 (feed rate for roughing) must be greater than 0, got 0
@@ 14
-  Q12=350
+  Q12=0

; == height-below-surface like corner
; 11:3 alarm: CYCL DEF 25 Q7 (clearance height) must not lie below the surface or the floor, got 15
@@ 10
-  Q5=0
-  Q7=50
+  Q5=20
+  Q7=15

; == infeed-0 like corner
; 12:3 alarm: CYCL DEF 25 Q10 (infeed per cut) must not be 0
@@ 12
-  Q10=5
+  Q10=0

; == inside-arc-too-small like corner
; 25:1 alarm: the inside arc of radius 4 is not greater than the tool radius 5: 1 mm is missing, the largest radius for the whole contour is 4 mm (take a smaller tool)
@@ 23
-L X+10 Y+10 RL
-L X+50
-L Y+50
+CC X+30 Y+30
+L X+30 Y+26 RL
+C X+30 Y+26 DR+

; == leaves-plane like corner
; 24:1 alarm: the contour of label 1 moves along the tool axis
@@ 23
-L X+10 Y+10 RL
-L X+50
-L Y+50
+L X+0 Y+0 RL
+L X+40 Z-5

; == needs-contour like corner
; 18:1 alarm: CYCL DEF 25 needs a contour: CYCL DEF 14 comes before it
@@ 5
-5 CYCL DEF 14.0 CONTOUR
-6 CYCL DEF 14.1 CONTOUR LABEL 1

; == tool-larger-than-contour like corner
; 24:1 alarm: the element is too short for the tool radius 5: the offsets of its neighbours do not meet on it: 0.5 mm are missing, the largest radius for the whole contour is 4.5 mm (take a smaller tool, or lengthen the element)
@@ 23
-L X+10 Y+10 RL
-L X+50
-L Y+50
+L X+0 Y+0 RL
+L X+9
+L Y+9
+L X+0
+L Y+0

; == with-tool-axis-x like corner
; 20:1 alarm: CYCL DEF 25 with the tool axis X: not built yet (with the tool axis Z it is)
@@ 3
-1 TOOL CALL 1 Z S2000 F400
-2 L X+0 Y+0 Z+100 R0 FMAX
+1 TOOL CALL 1 X S2000 F400
+2 L X+100 R0 FMAX

; == without-material-limit like corner
; 17:3 alarm: CYCL DEF 25 Q446 (accepted residual material) must be at least 0.001 and at most 9.999, got 0
@@ 17
-  Q446=0.01
+  Q446=0

; == cycle-270-approach-4 like corner
; 8:2 alarm: CYCL DEF 270 Q390 (type of approach) must be one of 1, 2, 3, got 4
@@ 7
+CYCL DEF 270 DATA
+ Q390=4
+ Q391=1
+ Q392=3
+ Q393=45
+ Q394=2

; == cycle-270-arc-of-361-degrees like corner
; 11:2 alarm: CYCL DEF 270 Q393 (centre angle of the arc) must be greater than 0 and at most 360, got 361
@@ 7
+CYCL DEF 270 DATA
+ Q390=1
+ Q391=1
+ Q392=3
+ Q393=361
+ Q394=2

; == cycle-270-arc-radius-0 like corner
; 10:2 alarm: CYCL DEF 270 Q392 (radius of the arc) must be greater than 0 for an approach on an arc, got 0
@@ 7
+CYCL DEF 270 DATA
+ Q390=1
+ Q391=1
+ Q392=0
+ Q393=45
+ Q394=2
