; == f-alone-needs-number
; 4:9 alarm: F needs a number
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 F

; -- cycle-200
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

; == f-greater-than-0-got-0-2 like cycle-200
; 14:29 alarm: F (feed rate) must be greater than 0, got 0
@@ 13
+3 L Z+50 R0 FMAX M3
+4 CYCL CALL POS X+1 Y+2 Z+2 F0

; == f-greater-than-0-got-0
; 4:9 alarm: F (feed rate) must be greater than 0, got 0
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 F0

; == f-needs-number-found-m-2
; 4:9 alarm: F needs a number, found 'M' (near: FMAX)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 FMX

; == f-needs-number-found-m
; 4:9 alarm: F needs a number, found 'M'
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 F MAXX

; == f100-fmax-stand-one-block-one like cycle-200
; 15:22 alarm: F100 and FMAX stand in one block: one feed is allowed
@@ 13
+3 L Z+50 R0 FMAX M3
+4 PATTERN DEF POS1 (X+10 Y+10 Z+0) POS2 (X+30 Y+10 Z+0)
+5 CYCL CALL PAT F100 FMAX

; == f100-fu0-1-stand-one-block
; 4:14 alarm: F100 and FU0.1 stand in one block: one feed is allowed
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 F100 FU0.1

; == fauto-fz0-1-stand-one-block
; 4:15 alarm: FAUTO and FZ0.1 stand in one block: one feed is allowed
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 FAUTO FZ,1

; == fauto-needs-feed-tool-call-block
; 2:9 alarm: FAUTO needs a feed in the TOOL CALL block (write TOOL CALL … F500)
1 L X+5 FAUTO

; == feed-per-revolution-needs-turning-spindle-2
; 6:1 alarm: a feed per revolution needs a turning spindle (write S and M3 before the move)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 FU0.2 M3
3 L X+6 M5
4 L X+7

; == feed-per-revolution-needs-turning-spindle
; 4:1 alarm: a feed per revolution needs a turning spindle (write S and M3 before the move)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 FU0.2

; == fmax-fauto-stand-one-block-one
; 4:9 alarm: FMAX and FAUTO stand in one block: one feed is allowed
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 FAUTO FMAX

; == fmax-no-meaning-this-block-2
; 4:17 alarm: FMAX has no meaning in this block (TOOL CALL does not take FMAX)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TOOL CALL 1 Z FMAX

; == fmax-no-meaning-this-block
; 6:15 alarm: FMAX has no meaning in this block (DEP LT does not take FMAX)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+9 RL
3 L X+20
4 DEP LT LEN5 FMAX

; == fu-greater-than-0-got-0
; 4:9 alarm: FU (feed per revolution) must be greater than 0, got 0
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 FU0

; == fz-greater-than-0-got-1
; 4:9 alarm: FZ (feed per tooth) must be greater than 0, got -1
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 FZ-1

; == fz0-1-needs-number-teeth-tool
; 5:9 alarm: FZ0.1 needs the number of teeth of tool 6 (column CUT of the tool table)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TOOL CALL 6 Z
3 L X+1 FZ0.1 M3

; == m103-f-greater-than-0-got
; 4:14 alarm: M103 F (percent of the feed downwards) must be greater than 0, got 0
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 M103 F0

; == m103-f-needs-number
; 4:14 alarm: M103 F needs a number (for example M103 F20: 20 percent)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 M103 F

; == m103-fq-is-its-own
; 4:15 alarm: no value was given to Q1
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 M103 FQ1

; == no-feed-rate-was-programmed-before-2
; 2:1 alarm: no feed rate was programmed before this move (write F or FMAX; with the setting feed_needed = False such a move is at rapid, with a warning)
L X+5

; == no-feed-rate-was-programmed-before-3
; 2:1 alarm: no feed rate was programmed before this move (write F)
1 APPR LT X+5 Y+5 LEN2 RL F100
2 L X+9

; == no-feed-rate-was-programmed-before
; 6:1 alarm: no feed rate was programmed before this move (write F or FMAX; with the setting feed_needed = False such a move is at rapid, with a warning)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 FZ0.1 M3
3 TOOL CALL 6
4 L X+9

; == number-missing-dwell-seconds
; 4:14 alarm: a number is missing: the dwell in seconds
TOOL CALL 1 Z S200 F100
CYCL DEF 9.0 D
CYCL DEF 9.1 TEMP

; == q12-fz-1-needs-number-teeth
; 6:1 alarm: Q12=FZ.1 needs the number of teeth of tool 6 (column CUT of the tool table)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TOOL CALL 6
3 CYCL DEF 22 D
Q12=FZ.1

; == q206-fu-greater-than-0-got
; 5:1 alarm: Q206=FU (feed per revolution) must be greater than 0, got 0
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 200 D
Q206=FU0

; == q206-fu-needs-value like cycle-200
; 7:1 alarm: Q206=FU needs its value (FU is the feed per revolution: write for example Q206=FU0.1)
@@ 7
-Q206=250
-Q202=0
+Q206=FU
+Q202=5

; == q206-fu0-1-needs-spindle-speed
; 6:1 alarm: Q206=FU0.1 needs a spindle speed (write S in the TOOL CALL block before the definition)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TOOL CALL S0
3 CYCL DEF 200 D
Q206=FU0.1

; == q206-fz-needs-value like cycle-200
; 7:1 alarm: Q206=FZ needs its value (FZ is the feed per tooth: write for example Q206=FZ0.1)
@@ 7
-Q206=250
-Q202=0
+Q206 = FZ
+Q202=5

; == q206-needs-number like cycle-200
; 7:1 alarm: Q206 needs a number
@@ 7
-Q206=250
-Q202=0
+Q206=
+Q202=5
