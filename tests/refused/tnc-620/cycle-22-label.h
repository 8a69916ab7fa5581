; -- trapezium
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L Z+50 R0 FMAX M3
3 CYCL DEF 14.0 C
4 CYCL DEF 14.1 CONTOUR LABEL1
5 CYCL DEF 20 D
Q1=-5
Q2=+1
Q3=+0
Q4=+0
Q5=+0
Q6=+2
Q7=+20
Q8=+0
Q9=+1
6 CYCL DEF 22 R
Q10=+5
Q11=+100
Q12=+200
Q18=+0
Q19=+0
Q208=+999
7 CYCL CALL
8 M30
9 LBL 1
10 L X+0 Y+0 RL
11 L X+60
12 L Y+40
13 L X+0
14 L Y+0
15 LBL 0
16 END PGM A MM

; == along-the-tool-axis like trapezium
; 28:1 alarm: the contour of label 1 moves along the tool axis
@@ 28
-11 L X+60
+11 L X+60 Z-3

; == begins-with-one-coordinate like trapezium
; 27:1 alarm: the contour of label 1 must begin with both coordinates of the plane
@@ 27
-10 L X+0 Y+0 RL
+10 L X+0 RL

; == crosses-itself like trapezium
; 31:1 alarm: the contour of label 1: the contour crosses or touches itself near (60.000, 0.000)
@@ 29
-12 L Y+40
-13 L X+0
+12 L X+0 Y+40
+13 L X+60

; == is-one-point like trapezium
; 27:1 alarm: label 1 describes no contour
@@ 28
-11 L X+60
-12 L Y+40
-13 L X+0
-14 L Y+0
-15 LBL 0
-16 END PGM A MM
+11 LBL 0
+12 END PGM A MM

; -- square
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000
2 CYCL DEF 14.0 C
CYCL DEF 14.1 CONTOUR LABEL 1
3 CYCL DEF 20 D
Q1=-5
Q2=+1
Q3=+0
Q4=+0
Q5=+0
Q6=+2
Q7=+20
Q8=+0
Q9=+1
4 CYCL DEF 22 R
Q10=+5
Q11=100
Q12=200
Q18=0
Q19=0
Q208=999
5 CYCL CALL M3
6 M30
LBL 1
L X+0 Y+0 RL
L X+40
L Y+40
L X+0
L Y+0
LBL 0
9 END PGM A MM

; == moves-along-z like square
; 28:1 alarm: the contour of label 1 moves along the tool axis
@@ 28
-L Y+40
+L Y+40 Z-1

; == with-two-sides like square
; 28:1 alarm: the contour of label 1 changes from RL to RR or back in this block
@@ 28
-L Y+40
+L Y+40 RR

; == without-side like square
; 26:1 alarm: the contour of label 1 has no RL or RR: pocket or island cannot be told apart
@@ 26
-L X+0 Y+0 RL
+L X+0 Y+0

; == without-value like trapezium
; 29:8 alarm: no value was given to Q77
@@ 29
-12 L Y+40
+12 L Y+Q77
