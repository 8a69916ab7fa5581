; == cycle-220-cannot-combined-with-cycle
; 11:1 alarm: CYCL DEF 220 cannot be combined with CYCL DEF 22 (Rough-out)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 22 R
Q10=5
Q11=100
Q12=200
Q18=0
Q19=0
Q208=FMAX
4 CYCL DEF 220 P
Q216=50
Q217=40
Q244=60
Q245=0
Q246=360
Q247=0
Q241=8
Q200=2
Q203=30
Q204=50
Q301=1
Q365=0

99 END PGM A MM

; -- cycle-220
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 200 D
Q200=2
Q201=-15
Q206=250
Q202=0
Q210=0
Q203=0
Q204=20
Q211=0
4 CYCL DEF 220 P
Q216=50
Q217=40
Q244=60
Q245=0
Q246=360
Q247=0
Q241=8
Q200=2
Q203=30
Q204=50
Q301=1
Q365=0

99 END PGM A MM

; == cycle-220-cannot-run-under-radius like cycle-220
; 14:1 alarm: CYCL DEF 220 cannot run under radius compensation: write R0 before it
@@ 13
+3 L X+5 RL F100

; == cycle-220-no-machining-cycle-run like cycle-220
; 4:1 alarm: CYCL DEF 220 has no machining cycle to run: define one before it, for example CYCL DEF 200
@@ 4
-2 CYCL DEF 200 D
-Q200=2
-Q201=-15
-Q206=250
-Q202=0
-Q210=0
-Q203=0
-Q204=20
-Q211=0

; == cycle-220-q200-number-got-fmax like cycle-220
; 21:1 alarm: CYCL DEF 220 Q200 (set-up clearance) must be a number, got FMAX
@@ 21
-Q200=2
+Q200=FMAX

; == cycle-220-q241-missing like cycle-220
; 13:1 alarm: CYCL DEF 220 Q241 (number of operations) is missing
@@ 20
-Q241=8

; == cycle-220-q241-whole-number-least-2 like cycle-220
; 20:1 alarm: CYCL DEF 220 Q241 (number of operations) must be a whole number and at least 1 and at most 99999, got 2.5
@@ 20
-Q241=8
+Q241=2.5

; == cycle-220-q241-whole-number-least like cycle-220
; 20:1 alarm: CYCL DEF 220 Q241 (number of operations) must be a whole number and at least 1 and at most 99999, got 0
@@ 20
-Q241=8
+Q241=0

; == cycle-220-q244-least-0-most like cycle-220
; 16:1 alarm: CYCL DEF 220 Q244 (diameter of the pitch circle) must be at least 0 and at most 99999.9999, got -1
@@ 16
-Q244=60
+Q244=-1

; == cycle-220-q245-least-360-most like cycle-220
; 17:1 alarm: CYCL DEF 220 Q245 (starting angle) must be at least -360 and at most 360, got 400
@@ 17
-Q245=0
+Q245=400

; == cycle-220-q246-differ-starting-angle like cycle-220
; 18:1 alarm: CYCL DEF 220 Q246 (stopping angle) must differ from the starting angle Q245, got 0
@@ 18
-Q246=360
+Q246=0

; == cycle-220-q301-one-0-1 like cycle-220
; 24:1 alarm: CYCL DEF 220 Q301 (level between the points) must be one of 0, 1, got 2
@@ 24
-Q301=1
+Q301=2

; == cycle-220-q365-one-0-1 like cycle-220
; 25:1 alarm: CYCL DEF 220 Q365 (way between the points) must be one of 0, 1, got 2
@@ 25
-Q365=0
+Q365=2

; == cycle-220-runs-202-with-tool-axis-x
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
5 CYCL DEF 221 P
Q225=0
Q226=0
Q237=10
Q238=10
Q242=2
Q243=1
Q224=0
Q200=2
Q203=0
Q204=20
Q301=1

; == cycle-221-no-machining-cycle-run
; 4:1 alarm: CYCL DEF 221 has no machining cycle to run: define one before it, for example CYCL DEF 200
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
4 CYCL DEF 221 L
Q225=15
Q226=25
Q237=10
Q238=8
Q242=6
Q243=4
Q224=15
Q200=2
Q203=30
Q204=50
Q301=1

99 END PGM A MM

; == cycle-221-q243-makes-1e-06
; 19:1 alarm: CYCL DEF 221 Q243 (number of lines) makes 1e+06 points, more than 100000
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 200 D
Q200=2
Q201=-15
Q206=250
Q202=0
Q210=0
Q203=0
Q204=20
Q211=0
4 CYCL DEF 221 L
Q225=15
Q226=25
Q237=10
Q238=8
Q242=1000
Q243=1000
Q224=15
Q200=2
Q203=30
Q204=50
Q301=1

99 END PGM A MM

; == cycle-221-q243-whole-number-least
; 19:1 alarm: CYCL DEF 221 Q243 (number of lines) must be a whole number and at least 1 and at most 99999, got 0
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 200 D
Q200=2
Q201=-15
Q206=250
Q202=0
Q210=0
Q203=0
Q204=20
Q211=0
4 CYCL DEF 221 L
Q225=15
Q226=25
Q237=10
Q238=8
Q242=6
Q243=0
Q224=15
Q200=2
Q203=30
Q204=50
Q301=1

99 END PGM A MM

; == cycle-224-not-function-this-control
; 4:1 alarm: CYCL DEF 224 is not a function of this control (near: CYCL DEF 22, CYCL DEF 220, CYCL DEF 221)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 224 P
99 END PGM A MM
