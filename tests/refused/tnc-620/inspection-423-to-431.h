; -- cycle-424
0 BEGIN PGM A MM
1 TOOL CALL 6 Z
2 L Z+100 R0 FMAX
3 TCH PROBE 424 X
Q273=+50
Q274=+50
Q282=80
Q283=60
Q261=-5
Q320=0
Q260=+10
Q301=1
Q284=0
Q285=0
Q286=0
Q287=0
Q279=0
Q280=0
Q281=1
Q309=0
Q330=0
4 END PGM A MM

; == tch-probe-423-after-shift like cycle-424
; 7:1 alarm: TCH PROBE 423 cannot run while a shift is active
@@ 5
-3 TCH PROBE 424 X
+CYCL DEF 7.0 X
+CYCL DEF 7.1 X+5
+3 TCH PROBE 423 X

; == tch-probe-423-narrower-than-ball like cycle-424
; 9:1 alarm: TCH PROBE 423 Q283 (length along the minor axis) must be greater than the ball, 4, got 3
@@ 5
-3 TCH PROBE 424 X
+3 TCH PROBE 423 X
@@ 9
-Q283=60
+Q283=3

; == tch-probe-424-after-mirror like cycle-424
; 7:1 alarm: TCH PROBE 424 cannot run while a mirror is active
@@ 5
+CYCL DEF 8.0 X
+CYCL DEF 8.1 X

; == tch-probe-424-limit-missing like cycle-424
; 5:1 alarm: TCH PROBE 424 Q287 (minimum limit of the second side) is missing
@@ 17
-Q287=0

; == tch-probe-424-side-negative like cycle-424
; 8:1 alarm: TCH PROBE 424 Q282 (length along the reference axis) must be at least 0 and at most 99999.9999, got -80
@@ 8
-Q282=80
+Q282=-80

; -- cycle-425
0 BEGIN PGM A MM
1 TOOL CALL 6 Z
2 L Z+100 R0 FMAX
3 TCH PROBE 425 X
Q328=+75
Q329=-12.5
Q310=+0
Q272=1
Q261=-5
Q260=+10
Q311=25
Q288=25.05
Q289=25
Q281=1
Q309=0
Q330=0
Q320=0
Q301=0
4 END PGM A MM

; == tch-probe-425-after-rotation like cycle-425
; 7:1 alarm: TCH PROBE 425 cannot run while a rotation is active
@@ 5
+CYCL DEF 10.0 X
+CYCL DEF 10.1 ROT+5

; == tch-probe-425-axis-3 like cycle-425
; 9:1 alarm: TCH PROBE 425 Q272 (measuring axis) must be one of 1, 2, got 3
@@ 9
-Q272=1
+Q272=3

; == tch-probe-425-nominal-missing like cycle-425
; 5:1 alarm: TCH PROBE 425 Q311 (nominal length) is missing
@@ 12
-Q311=25

; -- cycle-426
0 BEGIN PGM A MM
1 TOOL CALL 6 Z
2 L Z+100 R0 FMAX
3 TCH PROBE 426 X
Q263=+50
Q264=+25
Q265=+50
Q266=+85
Q272=2
Q261=-5
Q320=0
Q260=+20
Q311=45
Q288=45
Q289=44.95
Q281=1
Q309=0
Q330=0
4 END PGM A MM

; == tch-probe-426-after-scaling like cycle-426
; 7:1 alarm: TCH PROBE 426 cannot run while a scale is active
@@ 5
+CYCL DEF 11.0 X
+CYCL DEF 11.1 SCL 2

; == tch-probe-426-axis-3 like cycle-426
; 10:1 alarm: TCH PROBE 426 Q272 (measuring axis) must be one of 1, 2, got 3
@@ 10
-Q272=2
+Q272=3

; == tch-probe-426-one-coordinate like cycle-426
; 9:1 alarm: TCH PROBE 426 Q266 (second touch point, minor axis) is that of the first touch point: a ridge lies between two
@@ 9
-Q266=+85
+Q266=25

; -- cycle-427
0 BEGIN PGM A MM
1 TOOL CALL 6 Z
2 L Z+100 R0 FMAX
3 TCH PROBE 427 X
Q263=+35
Q264=+45
Q261=+5
Q320=0
Q272=3
Q267=-1
Q260=+20
Q281=1
Q288=5.1
Q289=4.95
Q309=0
Q330=0
4 END PGM A MM

; == tch-probe-427-after-axis-scaling like cycle-427
; 7:1 alarm: TCH PROBE 427 cannot run while a scale of an axis is active
@@ 5
+CYCL DEF 26.0 X
+CYCL DEF 26.1 X2

; == tch-probe-427-coordinate-too-far like cycle-427
; 8:1 alarm: TCH PROBE 427 Q261 (measuring height of the ball's center) must be at least -99999.9999 and at most 99999.9999, got 100000
@@ 8
-Q261=+5
+Q261=100000

; == tch-probe-427-direction-2 like cycle-427
; 11:1 alarm: TCH PROBE 427 Q267 (traverse direction) must be one of -1, 1, got 2
@@ 11
-Q267=-1
+Q267=2

; -- cycle-430
0 BEGIN PGM A MM
1 TOOL CALL 6 Z
2 L Z+100 R0 FMAX
3 TCH PROBE 430 X
Q273=+50
Q274=+50
Q262=80
Q291=+0
Q292=+90
Q293=+180
Q261=-5
Q260=+10
Q288=80.1
Q289=79.9
Q279=0.15
Q280=0.15
Q281=1
Q309=0
Q330=0
4 END PGM A MM

; == tch-probe-430-diameter-0 like cycle-430
; 8:1 alarm: TCH PROBE 430 Q262 (nominal diameter of the bolt hole circle) must be greater than 0, got 0
@@ 8
-Q262=80
+Q262=0

; == tch-probe-430-has-no-q320 like cycle-430
; 21:1 alarm: Q320=0 has no meaning in this block (TCH PROBE 430 does not take Q320) (a line Q… without a block number belongs to the definition above it: number it to assign a variable)
@@ 21
+Q320=0

; == tch-probe-430-one-hole-twice like cycle-430
; 11:1 alarm: TCH PROBE 430 Q293 (angle of the third hole) names the same hole again, got -270: three holes make a circle
@@ 11
-Q293=+180
+Q293=-270

; == tch-probe-430-under-compensation like cycle-430
; 7:1 alarm: TCH PROBE 430 cannot run under radius compensation
@@ 5
+L X+0 RL F100
+L X+50 Y+1

; -- cycle-431
0 BEGIN PGM A MM
1 TOOL CALL 6 Z
2 L Z+100 R0 FMAX
3 TCH PROBE 431 X
Q263=+20
Q264=+20
Q294=-10
Q265=+50
Q266=+80
Q295=+0
Q296=+90
Q297=+35
Q298=+12
Q320=0
Q260=+50
Q281=1
4 END PGM A MM

; == tch-probe-431-has-no-q330 like cycle-431
; 18:1 alarm: Q330=1 has no meaning in this block (TCH PROBE 431 does not take Q330) (a line Q… without a block number belongs to the definition above it: number it to assign a variable)
@@ 18
+Q330=1

; == tch-probe-431-no-part like cycle-431
; 5:1 alarm: there is no part to touch (give one: Setup(part=…); "cut" is what the program has cut)

; == tch-probe-431-points-on-a-line like cycle-431
; 12:1 alarm: TCH PROBE 431 Q296 (third touch point, reference axis) and the other points lie on one line: three points must span a plane
@@ 12
-Q296=+90
-Q297=+35
+Q296=80
+Q297=140
