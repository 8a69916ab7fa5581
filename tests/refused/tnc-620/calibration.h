; == tch-probe-441-no-feed
; 7:1 alarm: TCH PROBE 441 Q396 (positioning feed rate) must be greater than 0 where Q397 is 0
; 17.10: at no feed nothing would move
BEGIN PGM A MM
TOOL CALL 6 Z
L X+0 Y+0 Z+20 R0 FMAX
TCH PROBE 441 X
Q396=0
Q397=0
Q399=1
Q400=1

; == tch-probe-441-other-parameter
; 11:1 alarm: Q320=5 has no meaning in this block (TCH PROBE 441 does not take Q320) (a line Q… without a block number belongs to the definition above it: number it to assign a variable)
; 17.10: it has no Q320
BEGIN PGM A MM
TOOL CALL 6 Z
L X+0 Y+0 Z+20 R0 FMAX
TCH PROBE 441 X
Q396=3000
Q397=0
Q399=1
Q400=1
Q320=5

; == tch-probe-441-q397
; 8:1 alarm: TCH PROBE 441 Q397 (pre-positioning) must be one of 0, 1, got 2
; 17.10: Q397 is 0 or 1
BEGIN PGM A MM
TOOL CALL 6 Z
L X+0 Y+0 Z+20 R0 FMAX
TCH PROBE 441 X
Q396=3000
Q397=2
Q399=1
Q400=1

; == tch-probe-441-q399
; 9:1 alarm: TCH PROBE 441 Q399 (orienting the probe before each touch) must be one of 0, 1, got 2
; 17.10: Q399 is 0 or 1
BEGIN PGM A MM
TOOL CALL 6 Z
L X+0 Y+0 Z+20 R0 FMAX
TCH PROBE 441 X
Q396=3000
Q397=0
Q399=2
Q400=1

; == tch-probe-441-too-fast
; 7:1 alarm: TCH PROBE 441 Q396 (positioning feed rate) must be at least 0 and at most 99999.9999, got 100000
; 17.10: up to 99999.9999
BEGIN PGM A MM
TOOL CALL 6 Z
L X+0 Y+0 Z+20 R0 FMAX
TCH PROBE 441 X
Q396=100000
Q397=0
Q399=1
Q400=1

; -- cycle-460
BEGIN PGM A MM
TOOL CALL 6 Z
L X+0 Y+0 Z+20 R0 FMAX
TCH PROBE 460 X
Q407=12.5
Q320=0
Q301=1
Q423=4
Q380=0
Q433=0
Q434=0
Q455=0

; == tch-probe-460-half-a-point like cycle-460
; 10:1 alarm: TCH PROBE 460 Q423 (number of touch points) must be a whole number and at least 3 and at most 8, got 4.5
; 17.6: a number of points
@@ 10
-Q423=4
+Q423=4.5

; == tch-probe-460-no-radius like cycle-460
; 7:1 alarm: TCH PROBE 460 Q407 (exact radius of the calibration sphere) must be at least 0.0001 and at most 99.9999, got 0
; 17.6: at least 0.0001
@@ 7
-Q407=12.5
+Q407=0

; == tch-probe-460-q301 like cycle-460
; 9:1 alarm: TCH PROBE 460 Q301 (height between measuring points) must be one of 0, 1, got 2
; 17.6: Q301 is 0 or 1
@@ 9
-Q301=1
+Q301=2

; == tch-probe-460-q433 like cycle-460
; 12:1 alarm: TCH PROBE 460 Q433 (calibrating the length too) must be one of 0, 1, got -1
; 17.6: Q433 is 0 or 1
@@ 12
-Q433=0
+Q433=-1

; == tch-probe-460-too-many-points-3d like cycle-460
; 14:1 alarm: TCH PROBE 460 Q455 (touch points from pole to equator) must be a whole number and at least 0 and at most 30, got 31
; 17.6: at most 30
@@ 14
-Q455=0
+Q455=31

; == tch-probe-460-two-points like cycle-460
; 10:1 alarm: TCH PROBE 460 Q423 (number of touch points) must be a whole number and at least 3 and at most 8, got 2
; 17.6: 3 to 8 points
@@ 10
-Q423=4
+Q423=2

; == tch-probe-461-under-a-shift
; 8:1 alarm: TCH PROBE 461 cannot run while a shift is active
; 17.1: no transformation may be active
BEGIN PGM A MM
TOOL CALL 6 Z
L X+0 Y+0 Z+20 R0 FMAX
CYCL DEF 7.0 D
CYCL DEF 7.1 X+5
TCH PROBE 461 X
Q434=5

; == tch-probe-461-with-drill
; 5:1 alarm: TCH PROBE 461 needs a touch probe in the spindle, T2 is a drill
; 17.7: it calibrates the touch probe
BEGIN PGM A MM
TOOL CALL 2 Z
TCH PROBE 461 X
Q434=5

; == tch-probe-461-without-height
; 6:1 alarm: TCH PROBE 461 Q434 (height of the touched surface) is missing
; 17.7: Q434 is needed
BEGIN PGM A MM
TOOL CALL 6 Z
L X+0 Y+0 Z+20 R0 FMAX
TCH PROBE 461 X

; == tch-probe-461-without-tool
; 4:1 alarm: TCH PROBE 461 needs a tool call before it, which names the probe and its axis
; 17.7: a tool call defines the axis
BEGIN PGM A MM
TCH PROBE 461 X
Q434=5

; == tch-probe-462-angle
; 10:1 alarm: TCH PROBE 462 Q380 (angle of the first touch point) must be at least 0 and at most 360, got -1
; 17.8: 0 to 360 degrees
BEGIN PGM A MM
TOOL CALL 6 Z
L X+0 Y+0 Z+20 R0 FMAX
TCH PROBE 462 X
Q407=25
Q320=0
Q423=8
Q380=-1

; == tch-probe-462-negative-clearance
; 8:1 alarm: TCH PROBE 462 Q320 (set-up clearance) must be at least 0 and at most 99999.9999, got -1
; 17.8: Q320 is 0 or more
BEGIN PGM A MM
TOOL CALL 6 Z
L X+0 Y+0 Z+20 R0 FMAX
TCH PROBE 462 X
Q407=25
Q320=-1
Q423=8
Q380=0

; == tch-probe-462-nine-points
; 9:1 alarm: TCH PROBE 462 Q423 (number of touch points) must be a whole number and at least 3 and at most 8, got 9
; 17.8: 3 to 8 points
BEGIN PGM A MM
TOOL CALL 6 Z
L X+0 Y+0 Z+20 R0 FMAX
TCH PROBE 462 X
Q407=25
Q320=0
Q423=9
Q380=0

; == tch-probe-462-too-small
; 7:1 alarm: TCH PROBE 462 Q407 (radius of the ring) must be greater than the radius of the ball, 2, got 2
; 17.8: the ball of radius 2 does not enter
BEGIN PGM A MM
TOOL CALL 6 Z
L X+0 Y+0 Z+20 R0 FMAX
TCH PROBE 462 X
Q407=2
Q320=0
Q423=8
Q380=0

; == tch-probe-463-angle
; 11:1 alarm: TCH PROBE 463 Q380 (angle of the first touch point) must be at least 0 and at most 360, got 361
; 17.9: 0 to 360 degrees
BEGIN PGM A MM
TOOL CALL 6 Z
L X+0 Y+0 Z+20 R0 FMAX
TCH PROBE 463 X
Q407=10
Q320=0
Q301=1
Q423=8
Q380=361

; == tch-probe-463-too-large
; 7:1 alarm: TCH PROBE 463 Q407 (radius of the stud) must be at least 0 and at most 99.9999, got 100
; 17.9: up to 99.9999
BEGIN PGM A MM
TOOL CALL 6 Z
L X+0 Y+0 Z+20 R0 FMAX
TCH PROBE 463 X
Q407=100
Q320=0
Q301=1
Q423=8
Q380=0

; == tch-probe-463-under-a-rotation
; 8:1 alarm: TCH PROBE 463 cannot run while a rotation is active
; 17.1: no transformation may be active
BEGIN PGM A MM
TOOL CALL 6 Z
L X+0 Y+0 Z+20 R0 FMAX
CYCL DEF 10.0 R
CYCL DEF 10.1 ROT+5
TCH PROBE 463 X
Q407=10
Q320=0
Q301=1
Q423=8
Q380=0
