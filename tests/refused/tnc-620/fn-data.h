; == fn-14-error-whole-number-0
; 4:18 alarm: FN 14 ERROR must be a whole number from 0 to 1199, got 1200
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 14: ERROR = 1200

; == fn-14-needs-error-number
; 4:10 alarm: FN 14 needs ERROR = and a number (for example FN 14: ERROR = 1000)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 14: 1000

; == fn-16-file-missing
; 4:23 alarm: / and the file that is written are missing (for example FN 16: F-PRINT TNC:\MASK.A / TNC:\LOG.TXT)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 16: F-PRINT LOG.A

; == fn-16-no-text-qs1
; 4:26 alarm: no text was given to QS1
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 16: F-PRINT LOG.A / :'QS1'.TXT

; == fn-17-id50-no-row-9
; 4:19 alarm: FN 17: SYSWRITE ID50 NR4 IDX9: the tool table has no row 9
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 17: SYSWRITE ID 50 NR4 IDX9 = +0.1

; == fn-17-id50-radius-negative
; 4:19 alarm: FN 17: SYSWRITE ID50 NR2 IDX1: the radius of a tool must be at least 0, got -1
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 17: SYSWRITE ID 50 NR2 IDX1 = -1

; == fn-17-id50-teeth
; 4:19 alarm: FN 17: SYSWRITE ID50 NR15 IDX1: the teeth of a tool must be a whole number, got 2.5
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 17: SYSWRITE ID50 NR15 IDX1 = +2.5

; == fn-17-id50-type-77
; 4:36 alarm: FN 17: SYSWRITE ID50 NR36 IDX1 (TYPE): a tool here has no kind of the number 77
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 17: SYSWRITE ID50 NR36 IDX1 = +77

; == fn-17-syswrite-id990-nr5-not
; 4:19 alarm: FN 17: SYSWRITE ID990 NR5 is not built yet (ID990 NR6 is, and columns of the tool table, ID50)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 17: SYSWRITE ID 990 NR 5 = +1

; == fn-18-id10-nr3-no-cycle
; 4:23 alarm: FN 18: SYSREAD ID10 NR3 (number of the active machining cycle) has no value: no machining cycle is defined
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 18: SYSREAD Q1 = ID10 NR3

; == fn-18-id230-travel-not-known
; 4:24 alarm: FN 18: SYSREAD ID230 NR3 IDX3 (positive limit switch) has no value: the travel of the axis is not known: Setup(limits=mnclab.Limits(travel=…)) says it
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 18: SYSREAD Q30 = ID230 NR3 IDX3

; == fn-18-id240-under-compensation
; 5:23 alarm: FN 18: SYSREAD ID240 NR1 IDX1 (nominal position in the REF system) has no value: under radius compensation the tool stands beside the programmed point: write R0 before
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 Y+5 RL
3 FN 18: SYSREAD Q1 = ID240 NR1 IDX1

; == fn-18-id270-needs-idx
; 4:29 alarm: FN 18: SYSREAD ID270 NR1 (position in the active coordinate system) needs IDX
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 18: SYSREAD Q1 = ID270 NR1

; == fn-18-id320-no-time-of-day
; 4:23 alarm: FN 18: SYSREAD ID320 NR1 IDX0 (system time, seconds from 1970) has no value: a run has no time of day: the setting clock gives it one
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 18: SYSREAD Q1 = ID320 NR1 IDX0

; == fn-18-id50-no-row-77
; 4:23 alarm: FN 18: SYSREAD ID50 NR2 IDX77 (R of a tool) has no value: the tool table has no row 77
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 18: SYSREAD Q1 = ID50 NR2 IDX77

; == fn-18-id51-pocket-table-not
; 4:23 alarm: FN 18: SYSREAD ID51 NR1 IDX3 is not built yet
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 18: SYSREAD Q1 = ID51 NR1 IDX3

; == fn-18-sysread-id210-nr4-idx9
; 4:33 alarm: FN 18: SYSREAD ID210 NR4 IDX9 (active scaling factor) is not built yet for this index
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 18: SYSREAD Q1 = ID210 NR4 IDX9

; == fn-18-sysread-id990-nr6-idx1
; 4:23 alarm: FN 18: SYSREAD ID990 NR6 is not built yet (of ID990: NR10)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 18: SYSREAD Q1 = ID990 NR6

; == fn-24-no-value-q32
; 6:22 alarm: FN 24: no value was given to Q32 (4 points stand in 8 parameters)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 Q30 = 1
3 Q31 = 1
4 FN 24: Q20 = CDATA Q30

; == fn-25-axis-not-built
; 4:19 alarm: FN 25: the axis C is not built yet, X, Y and Z are
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 25: PRESET = C/+100/+0

; == fn-25-needs-second-number
; 4:25 alarm: / is missing (for example FN 25: PRESET = X/+100/+0)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 25: PRESET = X/+100

; == fn-25-while-shift-active
; 6:19 alarm: FN 25 cannot set the datum while a shift is active
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 7.0 X
3 CYCL DEF 7.1 X+5
4 FN 25: PRESET = X/+100/+0

; == fn-26-no-table
; 4:18 alarm: FN 26 T.TAB: there is no table of this name (Setup(files=…) has no files; the folder of fn-26-no-table.h has none)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 26: TABOPEN T.TAB

; == fn-27-columns-missing
; 4:21 alarm: the columns in quotes are missing (for example FN 27: TABWRITE 5/"X,Y" = Q5)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 27: TABWRITE 5/X = Q5

; == fn-28-needs-open-table
; 4:23 alarm: FN 28 needs an open table (FN 26: TABOPEN TAB1.TAB before it)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 28: TABREAD Q5 = 3/"X,Y"

; == fn-28-needs-row
; 4:23 alarm: a number or a Q parameter was expected (for example FN 28: TABREAD Q5 = 5/"X,Y")
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 28: TABREAD Q5 = "X"
