; -- cycle-200
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 200 D
Q200=2
Q201=-15
Q206=250
Q202=5
Q210=0
Q203=0
Q204=20
Q211=0

; == cycle-200-q200-least-0-most-2 like cycle-200
; 5:1 alarm: CYCL DEF 200 Q200 (set-up clearance) must be at least 0 and at most 99999.9999, got -1
@@ 8
-Q202=5
+Q202=0
@@ 13
+3 L Z+50 R0 FMAX M3
+4 PATTERN DEF POS1 (X+10 Y+10 Z+0) POS2 (X+30 Y+10 Z+0)
+5 Q200 = -1
+6 CYCL CALL PAT FMAX

; == cycle-200-q200-least-0-most like cycle-200
; 5:1 alarm: CYCL DEF 200 Q200 (set-up clearance) must be at least 0 and at most 99999.9999, got -2
@@ 5
-Q200=2
+Q200=-2

; == cycle-200-q200-needs-global-100
; 5:1 alarm: CYCL DEF 200 Q200 (set-up clearance) needs GLOBAL DEF 100 before it for PREDEF
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 200 D
Q200=PREDEF
Q201=-15
Q206=250
Q202=10
Q210=0
Q203=0
Q204=20
Q211=0

99 END PGM A MM

; == cycle-200-q201-negative-got-15 like cycle-200
; 6:1 alarm: CYCL DEF 200 Q201 (depth) must be negative, got 15: a positive depth works upwards
@@ 6
-Q201=-15
+Q201=15
@@ 13
+3 CYCL CALL M3

; == cycle-200-q201-no-default-predef
; 6:1 alarm: CYCL DEF 200 Q201 (depth) has no default: PREDEF is not allowed (write its value)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 200 D
Q200=2
Q201=PREDEF
Q206=250
Q202=10
Q210=0
Q203=0
Q204=20
Q211=0

99 END PGM A MM

; == cycle-200-q202-0-0001-divides like cycle-200
; 8:1 alarm: CYCL DEF 200 Q202 (infeed depth) 0.0001 divides 15 into more than 10000 infeeds
@@ 8
-Q202=5
+Q202=.0001
@@ 13
+3 CYCL CALL M3

; == cycle-200-q204-missing like cycle-200
; 4:1 alarm: CYCL DEF 200 Q204 (second set-up clearance) is missing
@@ 11
-Q204=20

; == cycle-200-q206-greater-than-0 like cycle-200
; 7:1 alarm: CYCL DEF 200 Q206 (feed rate for plunging) must be greater than 0 to drill with, got 0
@@ 7
-Q206=250
+Q206=0
@@ 13
+3 CYCL CALL M3

; == cycle-200-q206-number-fauto-fu-2
; 5:1 alarm: CYCL DEF 200 Q206 (feed rate for plunging) must be a number, FAUTO, FU, got FZ.1 (FU has its value behind it, for example Q206=FU0.1)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 200 D
Q206=FZ.1

; == cycle-200-q206-number-fauto-fu like cycle-200
; 7:1 alarm: CYCL DEF 200 Q206 (feed rate for plunging) must be a number, FAUTO, FU, got FMAX (FU has its value behind it, for example Q206=FU0.1)
@@ 7
-Q206=250
+Q206=FMAX

; == cycle-200-q211-needs-global-105 like cycle-200
; 12:1 alarm: CYCL DEF 200 Q211 (dwell at the bottom) needs GLOBAL DEF 105 before it for PREDEF
@@ 8
-Q202=5
+Q202=10
@@ 12
-Q211=0
+Q211=PREDEF
+
+99 END PGM A MM

; == cycle-200-q395-needs-point-angle like cycle-200
; 13:1 alarm: CYCL DEF 200 Q395 (depth reference) needs the point angle of tool 1 (T-ANGLE of the tool table)
@@ 13
+Q395=1
+3 CYCL CALL M3

; == cycle-200-q395-one-0-1 like cycle-200
; 13:1 alarm: CYCL DEF 200 Q395 (depth reference) must be one of 0, 1, got 2
@@ 13
+Q395=2

; == cycle-202-with-tool-axis-x
; 16:1 alarm: CYCL DEF 202 with the tool axis X: not built yet (with the tool axis Z it is)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TOOL CALL 1 X S100
3 L X+50 FMAX M3
4 CYCL DEF 202 B
Q200=2
Q201=-5
Q206=100
Q211=0
Q208=0
Q203=+0
Q204=20
Q214=1
Q336=0
5 CYCL CALL
