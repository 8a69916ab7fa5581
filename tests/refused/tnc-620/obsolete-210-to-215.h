; -- cycle-210
BEGIN PGM A MM
TOOL CALL 1 Z S1000
L X+20 Y+10 Z+2 R0 FMAX M3
CYCL DEF 210 X
Q200=2
Q201=-20
Q207=500
Q202=5
Q215=0
Q203=0
Q204=50
Q216=50
Q217=40
Q218=80
Q219=12
Q224=0
Q338=0
CYCL CALL
END PGM A MM

; == cycle-210-slot-infeed-0 like cycle-210
; 9:1 alarm: CYCL DEF 210 Q202 (infeed depth) must be greater than 0, got 0
@@ 9
-Q202=5
+Q202=0

; == cycle-210-slot-narrower-than-tool like cycle-210
; 16:1 alarm: CYCL DEF 210 Q219 (slot width) must be at least the tool diameter, 10, got 9
@@ 16
-Q219=12
+Q219=9

; == cycle-210-slot-too-short like cycle-210
; 15:1 alarm: CYCL DEF 210 Q218 (slot length) must be greater than twice the tool diameter and Q219, 20, got 20
@@ 15
-Q218=80
+Q218=20

; == cycle-210-slot-wider-than-three-tools like cycle-210
; 16:1 alarm: CYCL DEF 210 Q219 (slot width) must be at most three times the tool diameter, 30, got 31
@@ 16
-Q219=12
+Q219=31

; == cycle-211-slot-backwards like cycle-210
; 18:1 alarm: CYCL DEF 211 Q248 (angular length of the slot) must be at least 0 and at most 360, got -30
@@ 5
-CYCL DEF 210 X
+CYCL DEF 211 X
@@ 15
-Q218=80
+Q244=80
@@ 17
-Q224=0
+Q245=0
+Q248=-30

; == cycle-211-slot-wider-than-its-circle like cycle-210
; 15:1 alarm: CYCL DEF 211 Q244 (diameter of the pitch circle) must be greater than the slot width Q219, 12, got 12
@@ 5
-CYCL DEF 210 X
+CYCL DEF 211 X
@@ 15
-Q218=80
+Q244=12
@@ 17
-Q224=0
+Q245=0
+Q248=90

; == cycle-211-slot-without-length like cycle-210
; 18:1 alarm: CYCL DEF 211 Q248 (angular length of the slot) must make a way for the plunge, got 0 mm
@@ 5
-CYCL DEF 210 X
+CYCL DEF 211 X
@@ 15
-Q218=80
+Q244=80
@@ 17
-Q224=0
+Q245=0
+Q248=0

; -- cycle-213
BEGIN PGM A MM
TOOL CALL 1 Z S1000
L X+20 Y+10 Z+2 R0 FMAX M3
CYCL DEF 213 X
Q200=2
Q201=-20
Q206=150
Q202=8
Q207=500
Q203=0
Q204=50
Q216=50
Q217=40
Q218=80
Q219=60
Q220=8
Q221=3
CYCL CALL
END PGM A MM

; == cycle-212-pocket-corner-below-tool like cycle-213
; 17:1 alarm: CYCL DEF 212 Q220 (corner radius) must be 0 or at least the tool radius, 5, got 4
@@ 5
-CYCL DEF 213 X
+CYCL DEF 212 X
@@ 17
-Q220=8
+Q220=4

; == cycle-212-pocket-smaller-than-three-radii like cycle-213
; 16:1 alarm: CYCL DEF 212 Q219 (second side length) must be at least three times the tool radius, 15, got 14
@@ 5
-CYCL DEF 213 X
+CYCL DEF 212 X
@@ 16
-Q219=60
+Q219=14

; == cycle-213-stud-corner-too-large like cycle-213
; 17:1 alarm: CYCL DEF 213 Q220 (corner radius) must be at most half the shorter side, 30, got 31
@@ 17
-Q220=8
+Q220=31

; == cycle-213-stud-depth-positive like cycle-213
; 7:1 alarm: CYCL DEF 213 Q201 (depth) must be negative, got 20: a positive depth works upwards
@@ 7
-Q201=-20
+Q201=20

; == cycle-213-stud-infeed-0 like cycle-213
; 9:1 alarm: CYCL DEF 213 Q202 (infeed depth) must be greater than 0 to mill with, got 0
@@ 9
-Q202=8
+Q202=0

; == cycle-214-round-pocket-blank-too-large like cycle-213
; 15:1 alarm: CYCL DEF 214 Q222 (diameter of the rough pocket) must be less than the diameter of the finished pocket Q223, 80, got 80
@@ 5
-CYCL DEF 213 X
+CYCL DEF 214 X
@@ 15
-Q218=80
-Q219=60
-Q220=8
-Q221=3
+Q222=80
+Q223=80

; == cycle-214-round-pocket-smaller-than-tool like cycle-213
; 16:1 alarm: CYCL DEF 214 Q223 (diameter of the finished pocket) must be at least three times the tool radius, 15, got 9
@@ 5
-CYCL DEF 213 X
+CYCL DEF 214 X
@@ 15
-Q218=80
-Q219=60
-Q220=8
-Q221=3
+Q222=0
+Q223=9

; == cycle-215-round-stud-blank-too-small like cycle-213
; 15:1 alarm: CYCL DEF 215 Q222 (diameter of the blank) must be greater than the diameter of the finished stud Q223, 80, got 79
@@ 5
-CYCL DEF 213 X
+CYCL DEF 215 X
@@ 15
-Q218=80
-Q219=60
-Q220=8
-Q221=3
+Q222=79
+Q223=80

; == cycle-215-round-stud-plunge-feed-0
; 8:1 alarm: CYCL DEF 215 Q206 (feed rate for plunging) must be greater than 0 to mill with, got 0
BEGIN PGM A MM
TOOL CALL 1 Z S1000
L X+20 Y+10 Z+2 R0 FMAX M3
CYCL DEF 215 X
Q200=2
Q201=-20
Q206=0
Q202=8
Q207=500
Q203=0
Q204=50
Q216=50
Q217=40
Q222=82
Q223=80
CYCL CALL
END PGM A MM
