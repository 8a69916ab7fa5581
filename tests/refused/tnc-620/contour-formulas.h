; == contour-def-depth-twice
; 3:33 alarm: CONTOUR DEF P1: the depth stands twice
0 BEGIN PGM A MM
1 CONTOUR DEF P1 = LBL 1 DEPTH5 DEPTH6
2 M30
LBL 1
LBL 0
9 END PGM A MM

; -- square
0 BEGIN PGM A MM
1 CONTOUR DEF P1 = LBL 1
2 M30
LBL 1
L X+0 Y+0
L X+40
L Y+40
L X+0
L Y+0
LBL 0
9 END PGM A MM

; == contour-def-encloses-nothing like square
; 3:15 alarm: CONTOUR DEF encloses nothing
@@ 3
-1 CONTOUR DEF P1 = LBL 1
+1 CONTOUR DEF P1 = LBL 1 I2 = LBL 1

; == contour-def-first-an-island like square
; 3:15 alarm: CONTOUR DEF I1: the first part must be a pocket, the deepest one
@@ 3
-1 CONTOUR DEF P1 = LBL 1
+1 CONTOUR DEF I1 = LBL 1 P2 = LBL 1

; == contour-def-first-is-p2
; 3:15 alarm: CONTOUR DEF P2: the first part is P1, the deepest pocket
0 BEGIN PGM A MM
1 CONTOUR DEF P2 = LBL 1 I3 = LBL 1
2 M30
LBL 1
LBL 0
9 END PGM A MM

; == contour-def-negative-depth like square
; 3:26 alarm: CONTOUR DEF P1 DEPTH (depth of the contour) must be at least 0, got -5
@@ 3
-1 CONTOUR DEF P1 = LBL 1
+1 CONTOUR DEF P1 = LBL 1 DEPTH-5

; == contour-def-no-label like square
; 3:35 alarm: label "HOLE" does not exist (labels of this program: 1)
@@ 3
-1 CONTOUR DEF P1 = LBL 1
+1 CONTOUR DEF P1 = LBL 1 I2 = LBL "HOLE"

; == contour-def-no-program like square
; 3:31 alarm: CONTOUR DEF I2 NONE: there is no program of this name (Setup(files=…) has no files; the folder of contour-def-no-program.h has none)
@@ 3
-1 CONTOUR DEF P1 = LBL 1
+1 CONTOUR DEF P1 = LBL 1 I2 = "NONE"

; == contour-def-number-twice like square
; 4:1 alarm: CONTOUR DEF P2: the number 2 stands twice
@@ 3
-1 CONTOUR DEF P1 = LBL 1
+1 CONTOUR DEF P1 = LBL 1 I2 = LBL 1
+P2 = LBL 1

; == contour-def-part-begins-with-one-coordinate
; 6:1 alarm: the contour of label 1 must begin with both coordinates of the plane
0 BEGIN PGM A MM
1 CONTOUR DEF P1 = LBL 1
2 M30
LBL 1
L X+0
L X+40 Y+40
L X+0
LBL 0
9 END PGM A MM

; == contour-def-part-crosses-itself
; 9:1 alarm: the contour of label 1: the contour crosses or touches itself near (17.143, 17.143)
0 BEGIN PGM A MM
1 CONTOUR DEF P1 = LBL 1
2 M30
LBL 1
L X+0 Y+0
L X+40 Y+40
L X+40 Y+0
L X+0 Y+30
LBL 0
9 END PGM A MM

; == contour-def-part-is-a-line
; 6:1 alarm: the contour of label 1 encloses nothing
0 BEGIN PGM A MM
1 CONTOUR DEF P1 = LBL 1
2 M30
LBL 1
L X+0 Y+0
L X+40 Y+40
L X+0 Y+0
LBL 0
9 END PGM A MM

; == contour-def-part-outside-xy
; 9:1 alarm: the contour of label 1 leaves the plane XY
0 BEGIN PGM A MM
1 CONTOUR DEF P1 = LBL 1
2 M30
LBL 1
L X+0 Y+0
L X+40
CC X+30 Z+0
C X+30 Z+10 DR-
L X+0
LBL 0
9 END PGM A MM

; == contour-def-part-without-name like square
; 4:6 alarm: I2 needs the name of a program, or LBL and a label (for example CONTOUR DEF P1 = "POCKET" I2 = "ISLAND" DEPTH5)
@@ 4
+I2 = DEPTH5

; == contour-def-part-without-value
; 8:5 alarm: no value was given to Q77
0 BEGIN PGM A MM
1 CONTOUR DEF P1 = LBL 1
2 M30
LBL 1
L X+0 Y+0
L X+40
L Y+Q77
LBL 0
9 END PGM A MM

; == contour-def-ten-parts like square
; 3:114 alarm: CONTOUR DEF P10: there are at most 9 parts, 1 to 9
@@ 3
-1 CONTOUR DEF P1 = LBL 1
+1 CONTOUR DEF P1 = LBL 1 P2 = LBL 1 P3 = LBL 1 P4 = LBL 1 P5 = LBL 1 P6 = LBL 1 P7 = LBL 1 P8 = LBL 1 P9 = LBL 1 P10 = LBL 1

; == contour-def-with-tool-axis-x like square
; 4:22 alarm: CONTOUR DEF P1: contours are built for the tool axis Z alone
@@ 3
-1 CONTOUR DEF P1 = LBL 1
+1 TOOL CALL 1 X S100
+CONTOUR DEF P1 = LBL 1

; == contour-def-within-a-part
; 6:13 alarm: CONTOUR DEF cannot stand in the description of a contour
0 BEGIN PGM A MM
1 CONTOUR DEF P1 = LBL 1
2 M30
LBL 1
CONTOUR DEF P1 = LBL 2
L X+0 Y+0
L X+40
L Y+40
L X+0
L Y+0
LBL 0
LBL 2
L X+0 Y+0
L X+40
L Y+40
L X+0
L Y+0
LBL 0
9 END PGM A MM

; == contour-def-without-parts like square
; 3:1 alarm: CONTOUR DEF needs at least one pocket (for example CONTOUR DEF P1 = "POCKET")
@@ 3
-1 CONTOUR DEF P1 = LBL 1
+1 CONTOUR DEF

; == declare-contour-depth-twice
; 3:36 alarm: the depth stands twice (keep one of them)
0 BEGIN PGM A MM
1 DECLARE CONTOUR QC1 = "A" DEPTH5 DEPTH6
9 END PGM A MM

; == declare-contour-needs-designator
; 3:19 alarm: DECLARE CONTOUR needs a designator QC and its number (for example DECLARE CONTOUR QC1 = "CIRCLE" DEPTH5)
0 BEGIN PGM A MM
1 DECLARE CONTOUR Q1 = "A"
9 END PGM A MM

; == declare-contour-needs-equals
; 3:23 alarm: = is missing (for example DECLARE CONTOUR QC1 = "CIRCLE" DEPTH5)
0 BEGIN PGM A MM
1 DECLARE CONTOUR QC1 "A"
9 END PGM A MM

; == declare-contour-outside-definitions
; 3:19 alarm: DECLARE CONTOUR stands in a program of contour definitions alone (SEL CONTOUR "NAME" names that program; for a single block there is CONTOUR DEF)
0 BEGIN PGM A MM
1 DECLARE CONTOUR QC1 = "A"
9 END PGM A MM

; == declare-contour-qc-zero
; 3:19 alarm: QC0: the designators of contours count from QC1
0 BEGIN PGM A MM
1 DECLARE CONTOUR QC0 = "A"
9 END PGM A MM

; == qc-formula-bracket-not-opened
; 3:24 alarm: this bracket was not opened
0 BEGIN PGM A MM
1 QC12 = ( QC1 | QC2 ) ) \ QC3
9 END PGM A MM

; == qc-formula-designator-missing
; 3:16 alarm: a designator is missing before the operator (for example QC10 = ( QC1 | QC2 ) \ QC3)
0 BEGIN PGM A MM
1 QC12 = QC1 | | QC2
9 END PGM A MM

; == qc-formula-operator-missing
; 3:14 alarm: an operator is missing (one of & | ^ \)
0 BEGIN PGM A MM
1 QC12 = QC1 QC2
9 END PGM A MM

; == qc-formula-outside-definitions
; 4:3 alarm: QC1 = stands in a program of contour definitions alone (SEL CONTOUR "NAME" names that program; for a single block there is CONTOUR DEF)
0 BEGIN PGM A MM
1 L X+0 R0 FMAX
2 QC1 = QC2

; == qc-formula-product
; 3:14 alarm: * joins no contours (write &, or another one of & | ^ \)
0 BEGIN PGM A MM
1 QC12 = QC1 * (QC2 | QC3)
9 END PGM A MM

; == qc-formula-sum
; 3:21 alarm: + joins no contours (write |, or another one of & | ^ \)
0 BEGIN PGM A MM
1 QC12 = QC1 & (QC2 + QC3)
9 END PGM A MM

; == qc-formula-with-a-number
; 3:16 alarm: a formula of contours holds QC, operators and brackets (for example QC10 = ( QC1 | QC2 ) \ QC3)
0 BEGIN PGM A MM
1 QC12 = QC1 | 5
9 END PGM A MM

; == qc-with-a-sign
; 3:5 alarm: the number of a parameter, or of a contour, has no sign (for example QC10 =)
0 BEGIN PGM A MM
1 QC-1 = QC2
9 END PGM A MM

; == qc-zero
; 3:3 alarm: QC0: the designators of contours count from QC1
0 BEGIN PGM A MM
1 QC0 = QC1
9 END PGM A MM

; == sel-contour-needs-name
; 3:14 alarm: SEL CONTOUR needs the name of a program (for example SEL CONTOUR "MODEL")
0 BEGIN PGM A MM
1 SEL CONTOUR
9 END PGM A MM

; == sel-contour-no-program
; 3:15 alarm: SEL CONTOUR NONE: there is no program of this name (Setup(files=…) has no files; the folder of sel-contour-no-program.h has none)
0 BEGIN PGM A MM
1 SEL CONTOUR "NONE"
9 END PGM A MM
