; -- cycle-420
0 BEGIN PGM A MM
1 TOOL CALL 6 Z
2 L Z+100 R0 FMAX
3 TCH PROBE 420 X
Q263=+10
Q264=+10
Q265=+15
Q266=+95
Q272=1
Q267=-1
Q261=-5
Q320=0
Q260=+10
Q301=1
Q281=1
4 END PGM A MM

; == tch-probe-420-axis-4 like cycle-420
; 10:1 alarm: TCH PROBE 420 Q272 (measuring axis) must be one of 1, 2, 3, got 4
@@ 10
-Q272=1
+Q272=4

; == tch-probe-420-direction-0 like cycle-420
; 11:1 alarm: TCH PROBE 420 Q267 (traverse direction) must be one of -1, 1, got 0
@@ 11
-Q267=-1
+Q267=0

; == tch-probe-420-height-2 like cycle-420
; 15:1 alarm: TCH PROBE 420 Q301 (height between measuring points) must be one of 0, 1, got 2
@@ 15
-Q301=1
+Q301=2

; == tch-probe-420-neither-a-nor-b like cycle-420
; 10:1 alarm: TCH PROBE 420 Q272 (measuring axis) 3 measures an angle along an axis: Q265 must be Q263, or Q266 must be Q264
@@ 10
-Q272=1
+Q272=3

; == tch-probe-420-one-point like cycle-420
; 8:1 alarm: TCH PROBE 420 Q265 (second touch point, reference axis) and Q266 give the first touch point again: two points make an angle
@@ 8
-Q265=+15
-Q266=+95
+Q265=10
+Q266=10

; -- cycle-421
0 BEGIN PGM A MM
1 TOOL CALL 6 Z
2 L Z+100 R0 FMAX
3 TCH PROBE 421 X
Q273=+50
Q274=+50
Q262=30
Q325=+0
Q247=+90
Q261=-5
Q320=0
Q260=+20
Q301=0
Q275=30.1
Q276=30
Q279=0.1
Q280=0.1
Q281=0
Q309=0
Q330=0
Q423=4
Q365=1
4 END PGM A MM

; == tch-probe-421-has-no-q277 like cycle-421
; 24:1 alarm: Q277=1 has no meaning in this block (TCH PROBE 421 does not take Q277) (a line Q… without a block number belongs to the definition above it: number it to assign a variable)
@@ 24
+Q277=1

; == tch-probe-421-hole-smaller-than-ball like cycle-421
; 8:1 alarm: TCH PROBE 421 Q262 (nominal diameter) must be greater than the ball, 4, got 4
@@ 8
-Q262=30
+Q262=4

; == tch-probe-421-limit-missing like cycle-421
; 5:1 alarm: TCH PROBE 421 Q276 (minimum limit) is missing
@@ 16
-Q276=30

; == tch-probe-421-log-3 like cycle-421
; 19:1 alarm: TCH PROBE 421 Q281 (measuring log) must be one of 0, 1, 2, got 3
@@ 19
-Q281=0
+Q281=3

; == tch-probe-421-negative-limit like cycle-421
; 15:1 alarm: TCH PROBE 421 Q275 (maximum limit) must be at least 0 and at most 99999.9999, got -1
@@ 15
-Q275=30.1
+Q275=-1

; == tch-probe-421-negative-tolerance like cycle-421
; 17:1 alarm: TCH PROBE 421 Q279 (tolerance of the center, reference axis) must be at least 0 and at most 99999.9999, got -0.1
@@ 17
-Q279=0.1
+Q279=-0.1

; == tch-probe-421-points-5 like cycle-421
; 22:1 alarm: TCH PROBE 421 Q423 (number of touch points) must be one of 4, 3, got 5
@@ 22
-Q423=4
+Q423=5

; == tch-probe-421-step-above-120 like cycle-421
; 10:1 alarm: TCH PROBE 421 Q247 (stepping angle) must be at least -120 and at most 120, got -121
@@ 10
-Q247=+90
+Q247=-121

; == tch-probe-421-step-below-5 like cycle-421
; 10:1 alarm: TCH PROBE 421 Q247 (stepping angle) must be at least 5 or at most -5, got 4.9
@@ 10
-Q247=+90
+Q247=+4.9

; == tch-probe-421-stop-2 like cycle-421
; 20:1 alarm: TCH PROBE 421 Q309 (where a tolerance is exceeded) must be one of 0, 1, got 2
@@ 20
-Q309=0
+Q309=2

; == tch-probe-421-tool-negative like cycle-421
; 21:1 alarm: TCH PROBE 421 Q330 (tool that is monitored, number or name) must be at least 0 and at most 32767.9, got -1
@@ 21
-Q330=0
+Q330=-1

; == tch-probe-421-tool-not-in-table like cycle-421
; 21:1 alarm: TCH PROBE 421 Q330 (tool that is monitored, number or name) names tool 55, which has no row in the tool table
@@ 21
-Q330=0
+Q330=55

; == tch-probe-421-traverse-2 like cycle-421
; 23:1 alarm: TCH PROBE 421 Q365 (way between the touch points) must be one of 0, 1, got 2
@@ 23
-Q365=1
+Q365=2

; == tch-probe-421-without-tool-call like cycle-421
; 4:1 alarm: TCH PROBE 421 needs a tool call before it, which names the probe and its axis
@@ 3
-1 TOOL CALL 6 Z

; == tch-probe-422-clearance-negative like cycle-421
; 12:1 alarm: TCH PROBE 422 Q320 (set-up clearance) must be at least 0 and at most 99999.9999, got -1
@@ 5
-3 TCH PROBE 421 X
+3 TCH PROBE 422 X
@@ 12
-Q320=0
+Q320=-1
@@ 15
-Q275=30.1
-Q276=30
+Q277=30.1
+Q278=30

; == tch-probe-422-mill-in-spindle like cycle-421
; 5:1 alarm: TCH PROBE 422 needs a touch probe in the spindle, T1 is a mill
@@ 3
-1 TOOL CALL 6 Z
+1 TOOL CALL 1 Z
@@ 5
-3 TCH PROBE 421 X
+3 TCH PROBE 422 X
@@ 15
-Q275=30.1
-Q276=30
+Q277=30.1
+Q278=30

; == tch-probe-422-start-above-360 like cycle-421
; 9:1 alarm: TCH PROBE 422 Q325 (angle of the first touch point) must be at least -360 and at most 360, got 361
@@ 5
-3 TCH PROBE 421 X
+3 TCH PROBE 422 X
@@ 9
-Q325=+0
+Q325=361
@@ 15
-Q275=30.1
-Q276=30
+Q277=30.1
+Q278=30

; == tch-probe-422-step-0 like cycle-421
; 10:1 alarm: TCH PROBE 422 Q247 (stepping angle) must be at least 5 or at most -5, got 0
@@ 5
-3 TCH PROBE 421 X
+3 TCH PROBE 422 X
@@ 10
-Q247=+90
+Q247=+0
@@ 15
-Q275=30.1
-Q276=30
+Q277=30.1
+Q278=30
