; -- pocket
0 BEGIN PGM A MM
TOOL CALL 1 Z S2000 F500
L X+0 Y+0 Z+100 R0 FMAX M3
CYCL DEF 14.0 CONTOUR
CYCL DEF 14.1 CONTOUR LABEL 1
CYCL DEF 20 DATA
Q1=-10
Q2=+1
Q3=+9
Q4=+0.2
Q5=+0
Q6=+2
Q7=+50
Q8=+0
Q9=+1
CYCL DEF 24 SIDE
Q9=+1
Q10=+5
Q11=+130
Q12=+400
Q14=+0
Q438=+0
CYCL CALL
L Z+100 R0 FMAX M2
LBL 1
L X+10 Y+20 RL
CR X+90 Y+20 R+50 DR-
L X+10
LBL 0

; == arc-inside-label-wrong like pocket
; 28:14 alarm: R30 is too small for the distance 80 mm between start and end: at least 40 mm is needed (too short by 10 mm)
@@ 28
-CR X+90 Y+20 R+50 DR-
+CR X+90 Y+20 R+30 DR-

; -- pocket-with-island
0 BEGIN PGM A MM
TOOL CALL 1 Z S2000 F500
L X+0 Y+0 Z+100 R0 FMAX M3
CYCL DEF 14.0 CONTOUR
CYCL DEF 14.1 CONTOUR LABEL 1/2
CYCL DEF 20 DATA
Q1=-10
Q2=+1
Q3=+9
Q4=+0.2
Q5=+0
Q6=+2
Q7=+50
Q8=+0
Q9=+1
CYCL DEF 24 SIDE
Q9=+1
Q10=+5
Q11=+130
Q12=+400
Q14=+0
CYCL CALL
L Z+100 R0 FMAX M2
LBL 1
L X+10 Y+20 RR
L Y+80
L X+90
L Y+20
L X+10
LBL 0
LBL 2
CC X+50 Y+50
L X+40 Y+50 RL
C X+40 Y+50 DR-
LBL 0

; == contour-leaves-plane like pocket-with-island
; 29:1 alarm: the contour of label 1 moves along the tool axis
@@ 6
-CYCL DEF 14.1 CONTOUR LABEL 1/2
+CYCL DEF 14.1 CONTOUR LABEL 1
@@ 23
+Q438=+0
@@ 29
-L X+90
+L X+90 Z-5
@@ 33
-LBL 2
-CC X+50 Y+50
-L X+40 Y+50 RL
-C X+40 Y+50 DR-
-LBL 0

; == infeed-0 like pocket-with-island
; 19:1 alarm: CYCL DEF 24 Q10 (infeed per cut) must not be 0
@@ 10
-Q3=+9
+Q3=+0.5
@@ 19
-Q10=+5
+Q10=+0

; == island-crosses-itself like pocket
; 30:1 alarm: the contour of label 1: the contour crosses or touches itself near (50.000, 50.000)
@@ 28
-CR X+90 Y+20 R+50 DR-
-L X+10
+L X+90 Y+80
+L Y+20
+L X+10 Y+80
+L Y+20

; == needs-contour-data
; 13:1 alarm: CYCL DEF 24 needs its contour data: CYCL DEF 20 comes before it
0 BEGIN PGM A MM
TOOL CALL 1 Z S2000 F500
L X+0 Y+0 Z+100 R0 FMAX M3
CYCL DEF 14.0 CONTOUR
CYCL DEF 14.1 CONTOUR LABEL 1
CYCL DEF 24 SIDE
Q9=+1
Q10=+5
Q11=+130
Q12=+400
Q14=+0
CYCL CALL
M2
LBL 1
L X+10 Y+20 RR
L Y+80
L X+90
L Y+20
L X+10
LBL 0
LBL 2
CC X+50 Y+50
L X+40 Y+50 RL
C X+40 Y+50 DR-
LBL 0

; == rough-out-tool-below-1 like pocket-with-island
; 23:1 alarm: CYCL DEF 24 Q438 (rough-out tool) must be at least -1 and at most 32767.9, got -1.5
@@ 10
-Q3=+9
+Q3=+0.5
@@ 23
+Q438=-1.5

; == rough-out-tool-name-unknown like pocket-with-island
; 23:1 alarm: CYCL DEF 24 Q438 (rough-out tool) names tool "NOBODY", which has no row in the tool table
@@ 10
-Q3=+9
+Q3=+0.5
@@ 23
+QS438="NOBODY"

; == rough-out-tool-unknown like pocket-with-island
; 23:1 alarm: CYCL DEF 24 Q438 (rough-out tool) names tool 777, which has no row in the tool table
@@ 10
-Q3=+9
+Q3=+0.5
@@ 23
+Q438=+777

; == sense-0 like pocket-with-island
; 18:1 alarm: CYCL DEF 24 Q9 (direction of machining) must be one of -1, 1, got 0
@@ 10
-Q3=+9
+Q3=+0.5
@@ 18
-Q9=+1
+Q9=+0

; == too-many-infeeds like pocket-with-island
; 19:1 alarm: CYCL DEF 24 Q10 (infeed per cut) 0.0001 divides 10 into more than 10000 infeeds
@@ 10
-Q3=+9
+Q3=+0.5
@@ 19
-Q10=+5
+Q10=+0.0001
@@ 22
-Q14=+0
+Q14=-6

; == tool-as-large-as-allowed like pocket-with-island
; 30:1 alarm: CYCL DEF 24 cannot finish the side, the tool radius is too large: Q14 + R = 5.5 must be less than Q3 + R = 5.5 of the rough-out tool
@@ 10
-Q3=+9
+Q3=+0.5
@@ 17
+CYCL DEF 22 ROUGH-OUT
+Q10=+5
+Q11=+100
+Q12=+350
+Q19=+0
+Q208=+9999
+CYCL CALL
@@ 29
-Q14=+0
+Q14=+0.5

; == tool-does-not-fit like pocket
; 24:1 alarm: CYCL DEF 24: a tool of radius 5 with an allowance of 1 does not fit into the contour (take a smaller tool)
@@ 22
-Q14=+0
+Q14=+1
@@ 27
-L X+10 Y+20 RL
-CR X+90 Y+20 R+50 DR-
-L X+10
+L X+0 Y+0 RL
+L X+60
+L Y+11
+L X+0
+L Y+0

; == without-rough-out-tool like pocket-with-island
; 24:1 alarm: CYCL DEF 24 cannot finish the side, the tool radius is too large: Q14 + R = 5 must be less than Q3 + R = 0.5 of the rough-out tool
@@ 10
-Q3=+9
+Q3=+0.5
@@ 23
+Q438=+0
