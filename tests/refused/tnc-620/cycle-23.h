; == cycle-14-label-by-name
; 4:31 alarm: a contour label must be a whole number
0 BEGIN PGM A MM
1 CYCL DEF 14.0 C
2 CYCL DEF 14.1 CONTOUR LABEL "A1"
3 M30
LBL 1
L X+0 Y+0 RL
L X+60
L Y+40
L X+0 Y+0
LBL 0
9 END PGM A MM

; == cycle-14-label-in-a-parameter
; 4:31 alarm: a contour label must be a whole number
0 BEGIN PGM A MM
1 CYCL DEF 14.0 C
2 CYCL DEF 14.1 CONTOUR LABEL Q1
3 M30
LBL 1
L X+0 Y+0 RL
L X+60
L Y+40
L X+0 Y+0
LBL 0
9 END PGM A MM

; == cycle-14-label-negative
; 4:30 alarm: a contour label must be a whole number
0 BEGIN PGM A MM
1 CYCL DEF 14.0 C
2 CYCL DEF 14.1 CONTOUR LABEL-1
3 M30
LBL 1
L X+0 Y+0 RL
L X+60
L Y+40
L X+0 Y+0
LBL 0
9 END PGM A MM

; == cycle-14-within-a-part
; 6:1 alarm: CYCL DEF 14 cannot stand in a contour that a cycle reads, nor in a program of contour definitions
0 BEGIN PGM A MM
1 CONTOUR DEF P1 = LBL 1
2 M30
LBL 1
CYCL DEF 14.0 C
CYCL DEF 14.1 LABEL1
L X+0 Y+0
L X+40
L Y+40
L X+0
L Y+0
LBL 0
9 END PGM A MM

; -- pocket-with-island
0 BEGIN PGM A MM
TOOL CALL 1 Z S2000 F500
L X+0 Y+0 Z+100 R0 FMAX M3
CYCL DEF 14.0 CONTOUR
CYCL DEF 14.1 CONTOUR LABEL 1/2
CYCL DEF 20 DATA
Q1=-10
Q2=+1
Q3=+0.5
Q4=+0.2
Q5=+0
Q6=+2
Q7=+50
Q8=+0
Q9=+1
CYCL DEF 23 FLOOR
Q11=+120
Q12=+300
Q208=+8000
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

; == feed-fmax like pocket-with-island
; 19:1 alarm: CYCL DEF 23 Q12 (feed rate for finishing) must be a number, FAUTO, FU, FZ, got FMAX (FU has its value behind it, for example Q12=FU0.1)
@@ 19
-Q12=+300
+Q12=FMAX

; == islands-alone like pocket-with-island
; 21:1 alarm: the contour has no pocket (a pocket is clockwise with RR or counter-clockwise with RL)
@@ 6
-CYCL DEF 14.1 CONTOUR LABEL 1/2
+CYCL DEF 14.1 CONTOUR LABEL 2

; == needs-contour-data
; 11:1 alarm: CYCL DEF 23 needs its contour data: CYCL DEF 20 comes before it
0 BEGIN PGM A MM
TOOL CALL 1 Z S2000 F500
L X+0 Y+0 Z+100 R0 FMAX M3
CYCL DEF 14.0 CONTOUR
CYCL DEF 14.1 CONTOUR LABEL 1
CYCL DEF 23 FLOOR
Q11=+120
Q12=+300
Q208=+8000
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

; == needs-contour
; 9:1 alarm: CYCL DEF 23 needs a contour: CYCL DEF 14 comes before it
0 BEGIN PGM A MM
TOOL CALL 1 Z S2000 F500
L X+0 Y+0 Z+100 R0 FMAX M3
CYCL DEF 23 FLOOR
Q11=+120
Q12=+300
Q208=+8000
CYCL CALL

; == plunging-feed-0 like pocket-with-island
; 18:1 alarm: CYCL DEF 23 Q11 (feed rate for plunging) must be greater than 0 to mill with, got 0
@@ 18
-Q11=+120
+Q11=+0

; == strange-parameter like pocket-with-island
; 21:1 alarm: Q10=5 has no meaning in this block (CYCL DEF 23 does not take Q10) (a line Q… without a block number belongs to the definition above it: number it to assign a variable)
@@ 21
+Q10=+5
