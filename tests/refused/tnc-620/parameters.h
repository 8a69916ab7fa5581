; == asin-2-no-real-value
; 4:8 alarm: ASIN of 2 has no real value
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 Q1 = ASIN 2

; == bracket-no-meaning-behind-words
; 4:9 alarm: '(' has no meaning here (a comment begins with ;)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 (up)

; == division-zero-2
; 4:16 alarm: division by zero at /
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 Q1 = 2 ^ 0.5 / (1 - 1)

; == division-zero-div
; 4:17 alarm: division by zero at DIV
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 4: Q1 = +5 DIV +0

; == division-zero
; 4:17 alarm: division by zero at /
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 4: Q1 = +5 / 0

; == dwell-point-or-no-point
; 5:22 alarm: .5 may be 0.5 or 5 (write a blank before the number, and a digit before its point)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 9.0 X
3 CYCL DEF 9.1 V.ZEIT.5

; == expression-ends-where-number-or-variable-2
; 4:10 alarm: the expression ends where a number or a variable was expected
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 Q1 = 2 +

; == expression-ends-where-number-or-variable
; 4:12 alarm: the expression ends where a number or a variable was expected
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 Q1 = 3 * (

; == no-value-was-given-q1-2
; 4:13 alarm: no value was given to Q1
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 9: IF +Q1 EQU +3 GOTO LBL 1
3 LBL 1

; == no-value-was-given-q1
; 4:27 alarm: no value was given to Q1
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 APPR CT X+1 Y+2 CCA90 R+Q1 RL

; == no-value-was-given-q2-2
; 4:22 alarm: no value was given to Q2
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 4: Q1 = +5 DIV +Q2

; == no-value-was-given-q2
; 4:14 alarm: no value was given to Q2
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 0: Q1 = Q2

; == no-value-was-given-q5
; 4:7 alarm: no value was given to Q5
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+Q5

; == no-value-was-given-q7
; 4:13 alarm: no value was given to Q7
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TOOL CALL Q7 Z

; == number-or-q-parameter-was-expected-2
; 4:12 alarm: a number or a Q parameter was expected (for example FN 9: IF +Q1 EQU +Q3 GOTO LBL 5)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 9: IF EQU +3 GOTO LBL 5

; == number-or-q-parameter-was-expected
; 4:20 alarm: a number or a Q parameter was expected (for example FN 8: Q1 = +5 LEN +4)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 8: Q1 = +5 LEN

; == operator-was-expected-before-mod
; 4:10 alarm: an operator was expected before MOD
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 Q1 = 2 MOD 3

; == q1-holds-number-not-text
; 4:8 alarm: Q1 holds a number, not a text (texts stand in QS parameters)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 Q1 = "A"

; == q1-needs-value
; 4:7 alarm: Q1 = needs a value
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 Q1 =

; == q108-kept-control-cannot-assigned
; 4:3 alarm: Q108 (radius of the active tool with its deltas) is kept by the control and cannot be assigned (take another parameter)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 Q108 = 3

; == q113-kept-control-cannot-assigned
; 4:9 alarm: Q113 (unit of the main program) is kept by the control and cannot be assigned (take another parameter)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 0: Q113 = 1

; == q365-0-no-meaning-this-block
; 25:1 alarm: Q365=0 has no meaning in this block (CYCL DEF 221 does not take Q365) (a line Q… without a block number belongs to the definition above it: number it to assign a variable)
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
Q243=4
Q224=15
Q200=2
Q203=30
Q204=50
Q301=1
Q365=0

99 END PGM A MM

; == q5000-does-not-exist-q0-q1999
; 4:3 alarm: Q5000 does not exist: Q0 to Q1999, QL0 to QL499 and QR0 to QR499 are allowed
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 Q5000 = 3

; == q999-2-no-meaning-this-block
; 13:1 alarm: Q999=2 has no meaning in this block (CYCL DEF 200 does not take Q999) (a line Q… without a block number belongs to the definition above it: number it to assign a variable)
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
Q999=2

; == ql500-does-not-exist-q0-q1999
; 4:3 alarm: QL500 does not exist: Q0 to Q1999, QL0 to QL499 and QR0 to QR499 are allowed
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 QL500 = 3

; == qr500-does-not-exist-q0-q1999
; 4:9 alarm: QR500 does not exist: Q0 to Q1999, QL0 to QL499 and QR0 to QR499 are allowed
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 0: QR500 = 3

; == qs2000-does-not-exist-qs0-qs1999
; 4:3 alarm: QS2000 does not exist: QS0 to QS1999 are allowed
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 QS2000 = "A"

; == sqrt-4-no-real-value
; 4:14 alarm: SQRT of -4 has no real value
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 5: Q1 = SQRT -4
