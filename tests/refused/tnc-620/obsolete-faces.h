; -- cycle-230
BEGIN PGM A MM
TOOL CALL 1 Z S1000
L X+20 Y+10 Z+2 R0 FMAX M3
CYCL DEF 230 X
Q225=10
Q226=12
Q227=0
Q218=150
Q219=75
Q240=10
Q206=150
Q207=500
Q209=200
Q200=2
CYCL CALL
END PGM A MM

; == cycle-230-multipass-narrower-than-tool like cycle-230
; 10:1 alarm: CYCL DEF 230 Q219 (second side length) must be at least the tool diameter, 10, got 9
@@ 10
-Q219=75
+Q219=9

; == cycle-230-multipass-stepover-feed-0 like cycle-230
; 14:1 alarm: CYCL DEF 230 Q209 (feed rate for the stepover) must be greater than 0 to mill with, got 0
@@ 14
-Q209=200
+Q209=0

; == cycle-230-multipass-surface-parameter-q203 like cycle-230
; 16:1 alarm: Q203=0 has no meaning in this block (CYCL DEF 230 does not take Q203) (a line Q… without a block number belongs to the definition above it: number it to assign a variable)
@@ 16
+Q203=0

; == cycle-230-multipass-without-cuts like cycle-230
; 11:1 alarm: CYCL DEF 230 Q240 (number of cuts) must be a whole number and at least 1 and at most 99999, got 0
@@ 11
-Q240=10
+Q240=0

; -- cycle-231
BEGIN PGM A MM
TOOL CALL 1 Z S1000
L X+20 Y+10 Z+2 R0 FMAX M3
CYCL DEF 231 X
Q225=0
Q226=1
Q227=2
Q228=3
Q229=4
Q230=5
Q231=6
Q232=7
Q233=8
Q234=9
Q235=10
Q236=11
Q240=10
Q207=500
CYCL CALL
END PGM A MM

; == cycle-231-ruled-surface-feed-0 like cycle-231
; 19:1 alarm: CYCL DEF 231 Q207 (feed rate for milling) must be greater than 0 to mill with, got 0
@@ 19
-Q207=500
+Q207=0

; == cycle-231-ruled-surface-part-of-a-cut like cycle-231
; 18:1 alarm: CYCL DEF 231 Q240 (number of cuts) must be a whole number and at least 1 and at most 99999, got 2.5
@@ 18
-Q240=10
+Q240=2.5

; == cycle-231-ruled-surface-point-missing like cycle-231
; 5:1 alarm: CYCL DEF 231 Q236 (fourth point, tool axis) is missing
@@ 17
-Q236=11
