; -- groove
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F200
2 M3
3 CYCL DEF 14.0 CONTOUR
4 CYCL DEF 14.1 CONTOUR LABEL 1
5 CYCL DEF 27 CYLINDER
  Q1=-5
  Q3=+0
  Q6=20
  Q10=+5
  Q11=100
  Q12=200
  Q16=+40
  Q17=1
6 L X+0 Y+0 Z+100 R0 FMAX M99
7 M2
8 LBL 1
L X+0 Y+0 RL
L X+50
9 LBL 0
99 END PGM A MM

; == contour-appr like groove
; 20:9 alarm: APPR LT cannot stand in the contour of a cylinder (L, CHF, RND, CR and CT can)
@@ 19
-L X+0 Y+0 RL
+L X+0 Y+0 R0
+APPR LT X+10 Y+0 LEN5 RL

; == contour-c like groove
; 20:4 alarm: CC cannot stand in the contour of a cylinder (L, CHF, RND, CR and CT can)
@@ 20
-L X+50
+CC X+10 Y+0
+C X+20 Y+0 DR+

; == contour-dep like groove
; 21:8 alarm: DEP LT cannot stand in the contour of a cylinder (L, CHF, RND, CR and CT can)
@@ 21
+DEP LT LEN5

; == contour-fl like groove
; 20:10 alarm: FL cannot stand in the contour of a cylinder (L, CHF, RND, CR and CT can)
@@ 20
-L X+50
+FL AN+20 X+20

; == contour-lp like groove
; 20:4 alarm: LP cannot stand in the contour of a cylinder (L, CHF, RND, CR and CT can)
@@ 20
-L X+50
+LP PR+5 PA+20

; == contour-narrow-arc like groove
; 22:1 alarm: CYCL DEF 27: the inside arc of radius 3 is not greater than the distance 5: 2 mm are missing, the largest distance for the whole contour is 3 mm (take a smaller tool)
@@ 21
+RND R3
+L Y+50

; == contour-rotary-axis like groove
; 20:8 alarm: A5: the contour of a cylinder has X and Y alone, X for the rotary axis
@@ 20
-L X+50
+L X+20 A+5

; == contour-shift like groove
; 19:1 alarm: the contour of a cylinder takes no transformation
@@ 15
-  Q17=1
+  Q17=0
@@ 19
+CYCL DEF 7.0 X
+CYCL DEF 7.1 X+5
@@ 22
-L X+50
+L X+20

; == cylinder-datum-on-axis like groove
; 18:1 alarm: CYCL DEF 27 needs its datum on the axis of the cylinder, the shifts of the program move it 5 mm away
@@ 5
+2 CYCL DEF 7.0 X
+2 CYCL DEF 7.1 Y+5

; == depth-negative like groove
; 8:3 alarm: CYCL DEF 27 Q1 (milling depth from the surface to the floor) must be negative, got 5: the tool comes from outside, from inside is not built yet
@@ 8
-  Q1=-5
+  Q1=+5

; == depth-radius like groove
; 8:3 alarm: CYCL DEF 27 Q1 (milling depth from the surface to the floor) must be less deep than the radius Q16 = 40, got -40
@@ 8
-  Q1=-5
+  Q1=-40

; == fmax like groove
; 13:3 alarm: CYCL DEF 27 Q12 (feed rate for roughing) must be a number, FAUTO, FU, FZ, got FMAX (FU has its value behind it, for example Q12=FU0.1)
@@ 13
-  Q12=200
+  Q12=FMAX

; == q10-not-0 like groove
; 11:3 alarm: CYCL DEF 27 Q10 (infeed per cut) must be greater than 0, got 0
@@ 11
-  Q10=+5
+  Q10=+0

; == q11-not-0 like groove
; 12:3 alarm: CYCL DEF 27 Q11 (feed rate for plunging) must be greater than 0, got 0
@@ 12
-  Q11=100
+  Q11=0

; == q16-not-0 like groove
; 14:3 alarm: CYCL DEF 27 Q16 (radius of the cylinder) must be greater than 0, got 0
@@ 14
-  Q16=+40
+  Q16=+0

; == q3-without-side like groove
; 20:1 alarm: CYCL DEF 27: Q3=1 (finishing allowance for side) needs RL or RR in the contour (with R0 the tool is on the contour)
@@ 9
-  Q3=+0
+  Q3=+1
@@ 19
-L X+0 Y+0 RL
+L X+0 Y+0 R0

; == rotation-of-plane like groove
; 18:1 alarm: CYCL DEF 27 cannot run under a rotation of the plane: Y lies along the axis A
@@ 5
+2 CYCL DEF 10.0 X
+2 CYCL DEF 10.1 ROT+30

; == self like groove
; 23:1 alarm: CYCL DEF 27: the contour crosses itself
@@ 21
+L Y+50
+L X+25
+L Y-20

; == single-contour like groove
; 16:1 alarm: CYCL DEF 27 takes a single contour, but CYCL DEF 14 names 2 labels
@@ 6
-4 CYCL DEF 14.1 CONTOUR LABEL 1
+4 CYCL DEF 14.1 CONTOUR LABEL 1/1

; == tool-axis-x like groove
; 17:1 alarm: CYCL DEF 27 with the tool axis X: not built yet (with the tool axis Z it is)
@@ 5
+2 TOOL CALL 1 X S1000 F200

; == tool-square like groove
; 18:1 alarm: CYCL DEF 27 needs a tool square to the rotary axis C: the spindle axis is not perpendicular to the axis of the rotary table
@@ 5
+2 CYCL DEF 19.0 X
+2 CYCL DEF 19.1 B+45

; == unequal-scales like groove
; 18:1 alarm: CYCL DEF 27 cannot run under unequal scales: the cylinder would not be round
@@ 5
+2 CYCL DEF 26.0 X
+2 CYCL DEF 26.1 Z2
