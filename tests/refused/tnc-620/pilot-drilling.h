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
6 CYCL DEF 21 P
Q10=+5
Q11=+100
Q13=+0
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

; == cycle-21-drill-without-room like trapezium
; 21:1 alarm: CYCL DEF 21: the drill has at (30.000, 3.000) only 3.000 of room: with the allowance for side it needs 5 (take a smaller tool)
@@ 20
-Q13=+0
+Q13=+4
@@ 26
-12 L Y+40
+12 L Y+6

; == cycle-21-feed-0 like trapezium
; 19:1 alarm: CYCL DEF 21 Q11 (feed rate for plunging) must be greater than 0 to drill with, got 0
@@ 19
-Q11=+100
+Q11=+0

; == cycle-21-infeed-0 like trapezium
; 18:1 alarm: CYCL DEF 21 Q10 (infeed per cut) must not be 0
@@ 18
-Q10=+5
+Q10=+0

; == cycle-21-infeed-too-small like trapezium
; 18:1 alarm: CYCL DEF 21 Q10 (infeed per cut) 0.0001 divides 5 into more than 10000 infeeds
@@ 18
-Q10=+5
+Q10=+0.0001

; == cycle-21-rough-out-tool-name-not-there like trapezium
; 20:1 alarm: CYCL DEF 21 Q13 (rough-out tool) names tool "NOBODY", which has no row in the tool table
@@ 20
-Q13=+0
+QS13="NOBODY"

; == cycle-21-rough-out-tool-name-too-long like trapezium
; 20:1 alarm: CYCL DEF 21 Q13 (rough-out tool) must have at most 16 characters, got 19
@@ 20
-Q13=+0
+QS13="NOBODY OF THAT NAME"

; == cycle-21-rough-out-tool-not-there like trapezium
; 20:1 alarm: CYCL DEF 21 Q13 (rough-out tool) names tool 77, which has no row in the tool table
@@ 20
-Q13=+0
+Q13=+77

; == cycle-21-rough-out-tool-too-large like trapezium
; 21:1 alarm: CYCL DEF 21: the rough-out tool and the allowance for side, 8, do not fit into the contour (take a smaller tool)
@@ 20
-Q13=+0
+Q13=+5
@@ 26
-12 L Y+40
+12 L Y+14

; == cycle-21-without-contour like trapezium
; 19:1 alarm: CYCL DEF 21 needs a contour: CYCL DEF 14 comes before it
@@ 5
-3 CYCL DEF 14.0 C
-4 CYCL DEF 14.1 CONTOUR LABEL1

; == cycle-21-without-data like trapezium
; 11:1 alarm: CYCL DEF 21 needs its contour data: CYCL DEF 20 comes before it
@@ 7
-5 CYCL DEF 20 D
-Q1=-5
-Q2=+1
-Q3=+0
-Q4=+0
-Q5=+0
-Q6=+2
-Q7=+20
-Q8=+0
-Q9=+1
