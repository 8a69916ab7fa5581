; -- cycle-1
BEGIN PGM A MM
TOOL CALL 1 Z S1000
L X+20 Y+10 Z+2 R0 FMAX M3
CYCL DEF 1.0 X
CYCL DEF 1.1 SET UP 2
CYCL DEF 1.2 DEPTH -20
CYCL DEF 1.3 PECKG 5
CYCL DEF 1.4 DWELL 0
CYCL DEF 1.5 F80
CYCL CALL
END PGM A MM

; == cycle-1-pecking-depth-positive like cycle-1
; 7:14 alarm: CYCL DEF 1 DEPTH (depth) must be negative, got 20: a positive depth works upwards
@@ 7
-CYCL DEF 1.2 DEPTH -20
+CYCL DEF 1.2 DEPTH 20

; == cycle-1-pecking-feed-0 like cycle-1
; 10:14 alarm: CYCL DEF 1 F (feed rate for drilling) must be greater than 0 to drill with, got 0
@@ 10
-CYCL DEF 1.5 F80
+CYCL DEF 1.5 F0

; == cycle-1-pecking-infeed-0 like cycle-1
; 8:14 alarm: CYCL DEF 1 PECKG (infeed depth) must be greater than 0, got 0
@@ 8
-CYCL DEF 1.3 PECKG 5
+CYCL DEF 1.3 PECKG 0

; == cycle-1-pecking-infeed-too-small like cycle-1
; 8:14 alarm: CYCL DEF 1 PECKG (infeed depth) 0.001 divides 20 into more than 10000 infeeds
@@ 8
-CYCL DEF 1.3 PECKG 5
+CYCL DEF 1.3 PECKG 0.001

; == cycle-1-pecking-two-feeds like cycle-1
; 10:18 alarm: F stands twice
@@ 10
-CYCL DEF 1.5 F80
+CYCL DEF 1.5 F80 F90

; == cycle-1-pecking-without-feed
; 5:1 alarm: CYCL DEF 1 F (feed rate for drilling) is missing
BEGIN PGM A MM
TOOL CALL 1 Z S1000
L X+20 Y+10 Z+2 R0 FMAX M3
CYCL DEF 1.0 X
CYCL DEF 1.1 ABST 2
CYCL DEF 1.2 TIEFE -20
CYCL DEF 1.3 ZUSTLG 5
CYCL DEF 1.4 V.ZEIT 0
CYCL CALL
END PGM A MM

; == cycle-1-pecking-words-exchanged
; 6:14 alarm: TIEFE stands where the set-up clearance belongs
BEGIN PGM A MM
TOOL CALL 1 Z S1000
L X+20 Y+10 Z+2 R0 FMAX M3
CYCL DEF 1.0 X
CYCL DEF 1.1 TIEFE -20
CYCL DEF 1.2 ABST 2
CYCL DEF 1.3 ZUSTLG 5
CYCL DEF 1.4 V.ZEIT 0
CYCL DEF 1.5 F80
CYCL CALL
END PGM A MM

; == cycle-17-rigid-tapping-pitch-0
; 8:15 alarm: CYCL DEF 17 PITCH (thread pitch) must not be 0
BEGIN PGM A MM
TOOL CALL 1 Z S1000
L X+20 Y+10 Z+2 R0 FMAX M3
CYCL DEF 17.0 X
CYCL DEF 17.1 SET UP 2
CYCL DEF 17.2 DEPTH -20
CYCL DEF 17.3 PITCH 0
CYCL CALL
END PGM A MM

; == cycle-17-rigid-tapping-pitch-100
; 8:15 alarm: CYCL DEF 17 PITCH (thread pitch) must be at least -99.9999 and at most 99.9999, got 100
BEGIN PGM A MM
TOOL CALL 1 Z S1000
L X+20 Y+10 Z+2 R0 FMAX M3
CYCL DEF 17.0 X
CYCL DEF 17.1 SET UP 2
CYCL DEF 17.2 DEPTH -20
CYCL DEF 17.3 PITCH +100
CYCL CALL
END PGM A MM

; == cycle-17-rigid-tapping-pitch-missing
; 5:1 alarm: CYCL DEF 17 PITCH (thread pitch) is missing
BEGIN PGM A MM
TOOL CALL 1 Z S1000
L X+20 Y+10 Z+2 R0 FMAX M3
CYCL DEF 17.0 X
CYCL DEF 17.1 SET UP 2
CYCL DEF 17.2 DEPTH -20
CYCL CALL
END PGM A MM

; == cycle-18-depth-least-99999-most
; 4:15 alarm: CYCL DEF 18 DEPTH (depth of the thread from where the tool stands) must be at least -99999 and at most 99999, got -100000
TOOL CALL 1 Z S200 F100
CYCL DEF 18.0 T
CYCL DEF 18.1 DEPTH -100000
CYCL DEF 18.2 PITCH 1

; == cycle-18-needs-spindle-that-stands
; 7:1 alarm: CYCL DEF 18 needs a spindle that stands still: it would stop it and cut with no rotation; write M5 before
TOOL CALL 1 Z S200 F100
CYCL DEF 18.0 T
CYCL DEF 18.1 DEPTH -5
CYCL DEF 18.2 PITCH 1
L X1 M3
CYCL CALL

; == cycle-18-pitch-missing
; 3:1 alarm: CYCL DEF 18 PITCH (pitch of the thread) is missing
TOOL CALL 1 Z S200 F100
CYCL DEF 18.0 T
CYCL DEF 18.1 DEPTH -5
CYCL CALL

; == cycle-18-pitch-most-99999-9999
; 5:15 alarm: CYCL DEF 18 PITCH (pitch of the thread) must be at most 99999.9999 either way and not 0, got 0
TOOL CALL 1 Z S200 F100
CYCL DEF 18.0 T
CYCL DEF 18.1 DEPTH -5
CYCL DEF 18.2 PITCH 0
CYCL CALL

; == cycle-2-tapping-dwell-negative
; 8:14 alarm: CYCL DEF 2 DWELL (dwell at the bottom) must be at least 0 and at most 3600, got -1
BEGIN PGM A MM
TOOL CALL 1 Z S1000
L X+20 Y+10 Z+2 R0 FMAX M3
CYCL DEF 2.0 X
CYCL DEF 2.1 SET UP 2
CYCL DEF 2.2 DEPTH -20
CYCL DEF 2.3 DWELL -1
CYCL DEF 2.4 F500
CYCL CALL
END PGM A MM

; == cycle-2-tapping-pecking-depth
; 8:14 alarm: PECKG stands where the dwell in seconds belongs
BEGIN PGM A MM
TOOL CALL 1 Z S1000
L X+20 Y+10 Z+2 R0 FMAX M3
CYCL DEF 2.0 X
CYCL DEF 2.1 SET UP 2
CYCL DEF 2.2 DEPTH -20
CYCL DEF 2.3 PECKG 5
CYCL DEF 2.4 DWELL 0
CYCL DEF 2.5 F500
CYCL CALL
END PGM A MM

; == cycle-2-tapping-without-spindle
; 10:1 alarm: CYCL DEF 2 needs a turning spindle: write S in TOOL CALL, and M3 or M4 before
BEGIN PGM A MM
TOOL CALL 1 Z S1000
L X+20 Y+10 Z+2 R0 FMAX M5
CYCL DEF 2.0 X
CYCL DEF 2.1 SET UP 2
CYCL DEF 2.2 DEPTH -20
CYCL DEF 2.3 DWELL 0
CYCL DEF 2.4 F500
CYCL CALL
END PGM A MM
