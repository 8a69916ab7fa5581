; == call-within-a-label
; 31:1 alarm: CYCL CALL cannot stand in a contour that a cycle reads
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
CYCL CALL
LBL 0
9 END PGM A MM

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

; == coarse-tool-name-not-there like trapezium
; 21:1 alarm: CYCL DEF 22 Q18 (coarse roughing tool) names tool "NOBODY", which has no row in the tool table
@@ 21
-Q18=+0
+QS18="NOBODY"

; == coarse-tool-name-without-text like trapezium
; 21:1 alarm: CYCL DEF 22 Q18 (coarse roughing tool) names no tool: no text was given to QS9
@@ 21
-Q18=+0
+QS18=QS9

; == coarse-tool-not-there like trapezium
; 21:1 alarm: CYCL DEF 22 Q18 (coarse roughing tool) names tool 77, which has no row in the tool table
@@ 21
-Q18=+0
+Q18=+77

; == coarse-tool-without-radius like trapezium
; 22:1 alarm: CYCL DEF 22 Q18 (coarse roughing tool) names tool 21, which has no radius
@@ 3
+1 TOOL DEF 21 L+0 R+0
@@ 22
-Q18=+0
+Q18=+21

; == factor-0 like trapezium
; 24:1 alarm: CYCL DEF 22 Q401 (feed rate factor at full engagement) must be at least 0.0001 and at most 100, got 0
@@ 24
+Q401=+0

; == infeed-0 like trapezium
; 18:1 alarm: CYCL DEF 22 Q10 (infeed per cut) must not be 0
@@ 18
-Q10=+5
+Q10=0

; == plunge-feed-0 like trapezium
; 19:1 alarm: CYCL DEF 22 Q11 (feed rate for plunging) must be greater than 0 to mill with, got 0
@@ 19
-Q11=+100
+Q11=0

; == plunge-without-angle like trapezium
; 23:1 alarm: CYCL DEF 22 Q19 (feed rate for reciprocation) needs the plunge angle (ANGLE) of tool 21 in its table, 0.1 to 90 degrees, got 0
@@ 3
-1 TOOL CALL 1 Z S1000 F100
+1 TOOL DEF 21 L+0 R+5
+1 TOOL CALL 21 Z S1000 F100
@@ 23
-Q19=+0
+Q19=+80

; == pocket-begins-on-the-other
; 26:1 alarm: the contour of label 1 begins exactly on that of label 2: joined or common area is open (begin it inside the other contour (common area) or outside (joined))
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000
2 CYCL DEF 14.0 C
CYCL DEF 14.1 CONTOUR LABEL 1/2
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
LBL 2
L X+0 Y-10 RL
L X+20
L Y+20
L X+0
L Y-10
LBL 0
9 END PGM A MM

; == retraction-too-fast like trapezium
; 23:1 alarm: CYCL DEF 22 Q208 (retraction feed rate) must be at most 99999.9999 or FMAX, got 100000
@@ 23
-Q208=+999
+Q208=+100000

; == roughing-feed-0 like trapezium
; 20:1 alarm: CYCL DEF 22 Q12 (feed rate for roughing) must be greater than 0 to mill with, got 0
@@ 20
-Q12=+200
+Q12=0

; == strategy-2 like trapezium
; 24:1 alarm: CYCL DEF 22 Q404 (fine roughing strategy) must be one of 0, 1, got 2
@@ 24
+Q404=+2

; == too-many-levels like trapezium
; 18:1 alarm: CYCL DEF 22 Q10 (infeed per cut) 0.0001 divides 5 into more than 10000 infeeds
@@ 18
-Q10=+5
+Q10=+0.0001

; == too-many-rings like trapezium
; 24:1 alarm: CYCL DEF 22: a stepover of 0.0005 makes more than 2000 rings
@@ 9
-Q2=+1
+Q2=+0.0001

; == tool-too-large like trapezium
; 24:1 alarm: CYCL DEF 22: a tool of radius 8 does not fit into the contour (take a smaller tool)
@@ 3
-1 TOOL CALL 1 Z S1000 F100
+1 TOOL CALL 5 Z S1000 F100
@@ 29
-12 L Y+40
+12 L Y+14

; == tool-without-radius like trapezium
; 25:1 alarm: CYCL DEF 22 needs a tool with a radius, got 0
@@ 3
-1 TOOL CALL 1 Z S1000 F100
+1 TOOL DEF 21 L+0 R+0
+1 TOOL CALL 21 Z S1000 F100

; == with-tool-axis-y
; 25:1 alarm: CYCL DEF 22 with the tool axis Y: not built yet (with the tool axis Z it is)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TOOL CALL 1 Y S100
3 L Y+50 FMAX M3
4 CYCL DEF 14.0 C
5 CYCL DEF 14.1 CONTOUR LABEL1
6 CYCL DEF 20 D
Q1=-5
Q2=+1
Q3=+0
Q4=+0
Q5=+0
Q6=+2
Q7=+20
Q8=+0
Q9=+1
7 CYCL DEF 22 C
Q10=-5
Q11=100
Q12=200
Q18=0
Q19=0
Q208=999
8 CYCL CALL
9 M30
10 LBL 1
11 LBL 0

; == without-contour like trapezium
; 22:1 alarm: CYCL DEF 22 needs a contour: CYCL DEF 14 comes before it
@@ 5
-3 CYCL DEF 14.0 C
-4 CYCL DEF 14.1 CONTOUR LABEL1

; == without-data like trapezium
; 14:1 alarm: CYCL DEF 22 needs its contour data: CYCL DEF 20 comes before it
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
