; == cycl-call-no-cycle-call
; 4:1 alarm: CYCL CALL has no cycle to call (define one before, for example CYCL DEF 200)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL CALL

; -- drilled
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
3 L Z+50 R0 FMAX M3
4 L X+5 R0 FMAX M99

; == cycl-call-pos-cycle-called-position like drilled
; 14:1 alarm: CYCL CALL POS: a cycle is called at a position without radius compensation (write R0 in the block before)
@@ 13
-3 L Z+50 R0 FMAX M3
-4 L X+5 R0 FMAX M99
+3 L X+50 RL F100 M3
+4 CYCL CALL POS X+1 Y+2 Z+3

; == cycl-call-pos-no-cycle-call
; 4:1 alarm: CYCL CALL POS has no cycle to call (define one before, for example CYCL DEF 200)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL CALL POS X+1 Y+2 Z+3

; == cycl-call-pos-x-missing-all like drilled
; 14:1 alarm: CYCL CALL POS X is missing: all three coordinates are programmed
@@ 14
-4 L X+5 R0 FMAX M99
+4 CYCL CALL POS Y+2 Z+2

; == cycl-call-pos-z-missing-all like drilled
; 14:1 alarm: CYCL CALL POS Z is missing: all three coordinates are programmed
@@ 14
-4 L X+5 R0 FMAX M99
+4 CYCL CALL POS X+1 Y+2

; == m89-appr-lt-cycle-called-without like drilled
; 15:1 alarm: M89 and APPR LT: a cycle is called without radius compensation (end it with M99)
@@ 14
-4 L X+5 R0 FMAX M99
+4 L X+5 R0 FMAX M89
+5 APPR LT X+9 Y+9 LEN5 RL

; == m89-cycl-call-are-one-group like drilled
; 14:13 alarm: M89 and CYCL CALL are of one group: only one function of a group may stand in a block
@@ 14
-4 L X+5 R0 FMAX M99
+4 CYCL CALL M89

; == m89-no-cycle-call
; 4:17 alarm: M89 has no cycle to call (define one before, for example CYCL DEF 200)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 R0 FMAX M89

; == m99-cycle-called-position-without-radius like drilled
; 14:13 alarm: M99: a cycle is called at a position without radius compensation (write R0 in the block before)
@@ 8
-Q202=0
+Q202=5
@@ 13
-3 L Z+50 R0 FMAX M3
-4 L X+5 R0 FMAX M99
+3 L X+9 RL
+4 L X+10 M3 M99

; == m99-m89-are-one-group-only like drilled
; 14:21 alarm: M99 and M89 are of one group: only one function of a group may stand in a block
@@ 14
-4 L X+5 R0 FMAX M99
+4 L X+5 R0 FMAX M89 M99

; == m99-no-cycle-call
; 4:9 alarm: M99 has no cycle to call (define one before, for example CYCL DEF 200)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 M99
