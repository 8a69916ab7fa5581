; == call-lbl-0-lbl-0-end
; 4:12 alarm: CALL LBL 0: LBL 0 is the end of a subprogram and cannot be called
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CALL LBL 0

; == call-lbl-3-rep-section-begin
; 4:12 alarm: CALL LBL 3 REP: the section must begin before this block (REP repeats what stands above)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CALL LBL 3 REP 2
3 LBL 3

; == call-pgm-needs-name-program
; 4:11 alarm: CALL PGM needs the name of a program
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CALL PGM

; == call-selected-pgm-no-program-was
; 4:1 alarm: CALL SELECTED PGM: no program was chosen (write SEL PGM "NAME" before it)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CALL SELECTED PGM

; == calls-are-nested-deeper-than-20
; 5:12 alarm: calls are nested deeper than 20
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 LBL 1
3 CALL LBL 1

; == cycle-12-needs-name-program
; 5:20 alarm: CYCL DEF 12 needs the name of a program
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 12.0 PGM CALL
3 CYCL DEF 12.1 PGM

; == cycle-12-pgm-missing
; 4:1 alarm: CYCL DEF 12 PGM (name of the program) is missing
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 12.0 PGM CALL
3 L X+5

; == goto-lbl-missing
; 4:22 alarm: GOTO LBL is missing (for example FN 10: IF +Q1 NE +Q3 GOTO LBL 5)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 10: IF +1 NE +3 LBL 5

; == label-5-does-not-exist-2
; 4:31 alarm: label 5 does not exist (this program has no labels)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 9: IF +1 EQU +3 GOTO LBL 5

; == label-5-does-not-exist-3
; 5:31 alarm: label 5 does not exist (labels of this program: 1)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 LBL 1
3 FN 11: IF +1 GT +0 GOTO LBL 5

; == label-5-does-not-exist
; 4:12 alarm: label 5 does not exist (this program has no labels)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CALL LBL 5

; == label-b-does-not-exist-2
; 5:12 alarm: label "B" does not exist (this program has no labels)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 QS1 = "B"
3 CALL LBL QS1

; == label-b-does-not-exist
; 4:12 alarm: label "B" does not exist (this program has no labels)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CALL LBL "B"

; == label-number-0-65535-got-70000
; 4:7 alarm: a label must be a number from 0 to 65535, got 70000
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 LBL 70000

; == label-whole-number-or-name-quotes
; 4:7 alarm: a label must be a whole number or a name in quotes (for example LBL 1 or LBL "HOLES")
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 LBL QS1

; == lbl-1-set-twice
; 6:7 alarm: LBL 1 is set twice (a label stands for one place in the program)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 LBL 1
3 LBL 0
4 LBL 1

; == lbl-set-twice
; 5:7 alarm: LBL "A" is set twice (a label stands for one place in the program)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 LBL "A"
3 LBL "A"

; == name-file-missing
; 3:10 alarm: the name of a file is missing (for example SEL PATTERN "HOLES")
TOOL CALL 1 Z S1000 F100
SEL TABLE

; == name-label-empty
; 4:7 alarm: the name of a label is empty
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 LBL ""

; == rep-2-no-meaning-this-block
; 5:14 alarm: REP-2 has no meaning in this block
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 LBL 1
3 CALL LBL 1 REP -2

; == rep-q-negative
; 7:14 alarm: CALL LBL REP (repeats) must be a whole number from 0 to 999999999, got -2
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 Q1 = -2
3 LBL 1
4 L IX+3 FMAX
5 CALL LBL 1 REP Q1

; == rep-q-whole-number
; 7:14 alarm: CALL LBL REP (repeats) must be a whole number from 0 to 999999999, got 2.5
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 Q1 = 2.5
3 LBL 1
4 L IX+3 FMAX
5 CALL LBL 1 REPQ1

; == rep-text-needs-number
; 5:14 alarm: REP needs a number, found 'X'
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 LBL 1
3 CALL LBL 1 REP X

; == sel-pgm-needs-name-program
; 4:10 alarm: SEL PGM needs the name of a program
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 SEL PGM
