; -- cycle-3
BEGIN PGM A MM
TOOL CALL 1 Z S1000
L X+20 Y+10 Z+2 R0 FMAX M3
CYCL DEF 3.0 X
CYCL DEF 3.1 SET UP 2
CYCL DEF 3.2 DEPTH -15
CYCL DEF 3.3 PECKG 5 F80
CYCL DEF 3.4 X50
CYCL DEF 3.5 Y15
CYCL DEF 3.6 F120
CYCL CALL
END PGM A MM

; == cycle-3-slot-along-z like cycle-3
; 9:14 alarm: Z50 has no meaning in this block (CYCL DEF 3 does not take Z)
@@ 9
-CYCL DEF 3.4 X50
+CYCL DEF 3.4 Z50

; == cycle-3-slot-narrower-than-tool like cycle-3
; 10:14 alarm: CYCL DEF 3 Y (side along Y) must be at least the tool diameter, 10, got 9
@@ 10
-CYCL DEF 3.5 Y15
+CYCL DEF 3.5 Y9

; == cycle-3-slot-plunge-feed-missing like cycle-3
; 5:1 alarm: CYCL DEF 3 PECKG:F (feed rate for plunging) is missing
@@ 8
-CYCL DEF 3.3 PECKG 5 F80
+CYCL DEF 3.3 PECKG 5

; == cycle-3-slot-square like cycle-3
; 9:14 alarm: CYCL DEF 3 X (side along X) must be less than the other side, 15, got 15
@@ 9
-CYCL DEF 3.4 X50
+CYCL DEF 3.4 X15

; == cycle-3-slot-wider-than-two-tools like cycle-3
; 10:14 alarm: CYCL DEF 3 Y (side along Y) must be at most twice the tool diameter, 20, got 21
@@ 10
-CYCL DEF 3.5 Y15
+CYCL DEF 3.5 Y21

; -- cycle-4
BEGIN PGM A MM
TOOL CALL 1 Z S1000
L X+20 Y+10 Z+2 R0 FMAX M3
CYCL DEF 4.0 X
CYCL DEF 4.1 SET UP 2
CYCL DEF 4.2 DEPTH -15
CYCL DEF 4.3 PECKG 5 F80
CYCL DEF 4.4 X50
CYCL DEF 4.5 Y30
CYCL DEF 4.6 F120 DR+
CYCL CALL
END PGM A MM

; == cycle-4-pocket-corner-below-tool like cycle-4
; 11:23 alarm: CYCL DEF 4 RADIUS (corner radius) must be 0 or at least the tool radius, 5, got 3
@@ 11
-CYCL DEF 4.6 F120 DR+
+CYCL DEF 4.6 F120 DR+ RADIUS 3

; == cycle-4-pocket-narrower-than-tool like cycle-4
; 9:14 alarm: CYCL DEF 4 X (side along X) must be at least twice the radius of tool and corner, 10, got 9
@@ 9
-CYCL DEF 4.4 X50
-CYCL DEF 4.5 Y30
-CYCL DEF 4.6 F120 DR+
+CYCL DEF 4.4 X9
+CYCL DEF 4.5 Y24
+CYCL DEF 4.6 F120 DR+ RADIUS 0

; == cycle-4-pocket-too-narrow-for-corners like cycle-4
; 10:14 alarm: CYCL DEF 4 Y (side along Y) must be greater than twice RADIUS and the stepover, 25, got 24
@@ 10
-CYCL DEF 4.5 Y30
-CYCL DEF 4.6 F120 DR+
+CYCL DEF 4.5 Y24
+CYCL DEF 4.6 F120 DR+ RADIUS 10

; == cycle-4-pocket-without-sense like cycle-4
; 5:1 alarm: CYCL DEF 4 DR (sense of the path) is missing
@@ 11
-CYCL DEF 4.6 F120 DR+
+CYCL DEF 4.6 F120

; -- cycle-5
BEGIN PGM A MM
TOOL CALL 1 Z S1000
L X+20 Y+10 Z+2 R0 FMAX M3
CYCL DEF 5.0 X
CYCL DEF 5.1 SET UP 2
CYCL DEF 5.2 DEPTH -15
CYCL DEF 5.3 PECKG 5 F80
CYCL DEF 5.4 RADIUS 40
CYCL DEF 5.5 F120 DR+
CYCL CALL
END PGM A MM

; == cycle-5-round-pocket-narrower-than-tool like cycle-5
; 9:14 alarm: CYCL DEF 5 RADIUS (radius of the pocket) must be at least the tool radius, 5, got 4
@@ 9
-CYCL DEF 5.4 RADIUS 40
-CYCL DEF 5.5 F120 DR+
+CYCL DEF 5.4 RADIUS 4
+CYCL DEF 5.5 F120 DR-

; == cycle-5-round-pocket-sense-without-sign like cycle-5
; 10:21 alarm: DR needs + or -
@@ 10
-CYCL DEF 5.5 F120 DR+
+CYCL DEF 5.5 F120 DR

; == cycle-5-round-pocket-two-senses like cycle-5
; 10:23 alarm: DR stands twice
@@ 10
-CYCL DEF 5.5 F120 DR+
+CYCL DEF 5.5 F120 DR+ DR-
