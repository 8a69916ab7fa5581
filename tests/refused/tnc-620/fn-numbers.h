; == fn-0-gives-number-qs1-cannot
; 4:9 alarm: FN 0 gives a number: QS1 cannot hold it (take a Q, QL or QR parameter)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 0: QS1 = 3

; == fn-0-needs-q-parameter-2
; 4:9 alarm: FN 0 needs a Q parameter and = (FN 0: Q1 = +2)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 0: 5 = 3

; == fn-0-needs-q-parameter
; 4:11 alarm: FN 0 needs a Q parameter and = (FN 0: Q1 = +2)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 0: Q1

; == fn-10-compares-with-ne
; 4:16 alarm: FN 10 compares with NE (for example FN 10: IF +Q1 NE +Q3 GOTO LBL 5)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 10: IF Q1 IS DEFINED GOTO LBL 5

; == fn-12-goto-lbl-0-lbl
; 4:31 alarm: FN 12 GOTO LBL 0: LBL 0 is the end of a subprogram and no place to go to
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 12: IF +1 LT +3 GOTO LBL 0

; == fn-13-two-sides-length-0
; 4:15 alarm: FN 13: two sides of length 0 have no angle
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 13: Q1 = +0 ANG +0

; == fn-15-needs-print
; 4:10 alarm: FN 15 needs PRINT (for example FN 15: PRINT 1/Q1/Q2)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 15: Q1

; == fn-23-needs-cdata
; 4:16 alarm: FN 23 needs CDATA (for example FN 23: Q20 = CDATA Q30)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 23: Q20 = Q30

; == fn-23-parameters-do-not-exist
; 4:22 alarm: 6 parameters from Q1995 on do not exist: the last is Q1999
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 23: Q20 = CDATA Q1995

; == fn-23-points-lie-on-line
; 10:22 alarm: FN 23: the points lie on a line, no circle goes through them
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 Q30 = 1
3 Q31 = 1
4 Q32 = 2
5 Q33 = 2
6 Q34 = 5
7 Q35 = 5
8 FN 23: Q20 = CDATA Q30

; == fn-9-compares-with-equ
; 4:15 alarm: FN 9 compares with EQU (for example FN 9: IF +Q1 EQU +Q3 GOTO LBL 5)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 9: IF +1 GT +3 GOTO LBL 5

; == fn-9-needs-if
; 4:9 alarm: FN 9 needs IF (for example FN 9: IF +Q1 EQU +Q3 GOTO LBL 5)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 9: Q1 EQU 3

; == fn-99-not-function-this-control-2
; 2:1 alarm: FN 99 is not a function of this control (near: FN 9, FN 19, FN 29)
1 FN 99 X

; == fn-99-not-function-this-control
; 4:1 alarm: FN 99 is not a function of this control (near: FN 9, FN 19, FN 29)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 99: Q1 = 3

; == function-have-form-fn-0-q1
; 4:14 alarm: the function must have the form FN 0: Q1 = +2
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 0: Q1 = +5 + +3

; == function-have-form-fn-1-q1
; 4:14 alarm: the function must have the form FN 1: Q1 = +2 + +3
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 1: Q1 = +1

; == function-have-form-fn-2-q1
; 4:14 alarm: the function must have the form FN 2: Q1 = +2 - +3
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 2: Q1 = 3 - 4 - 5

; == function-have-form-fn-6-q1
; 4:14 alarm: the function must have the form FN 6: Q1 = SIN -Q5
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 6: Q1 = SIN(30)

; == function-have-form-fn-8-q1
; 4:14 alarm: the function must have the form FN 8: Q1 = +5 LEN +4
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 8: Q1 = +5 + +4
