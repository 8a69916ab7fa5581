; == begin-pgm-stands-twice-file-holds
; 4:3 alarm: BEGIN PGM stands twice: a file holds one program
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 BEGIN PGM B MM

; == calllbl-no-statement
; 4:3 alarm: CALLLBL is no statement of this control (near: CALL LBL)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CALLLBL 1

; == comment-rest-near-a-statement
; 5:1 alarm: STOPS is no statement of this control (near: STOP; if it is the rest of the comment above, begin it with ;)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L Z+50 R0 FMAX ; the spindle
stops here
3 END PGM A MM

; == comment-rest-with-a-word
; 5:1 alarm: OF is no statement of this control (if it is the rest of the comment above, begin it with ;)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 ; a comment that an editor wrapped in the middle
of what it says about X+5
3 END PGM A MM

; == cycl-cal-no-statement
; 4:3 alarm: CYCL is no statement of this control (near: CYCL CALL)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL CAL

; == cycle-def-no-statement
; 4:3 alarm: CYC is no statement of this control (near: CYCL DEF)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYC DEF 9.0 DWELL TIME

; == cylc-def-no-statement
; 4:3 alarm: CYLC is no statement of this control (near: CYCL DEF)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYLC DEF 200 DRILLING

; == dwell-no-statement
; 4:3 alarm: DWELL is no statement of this control (a dwell is FUNCTION DWELL TIME2 or cycle 9)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 DWELL F2.5

; == end-pgm-says-inch-begin-pgm
; 4:13 alarm: END PGM says INCH, BEGIN PGM MM
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 END PGM A INCH

; == error-of-a-control
; 4:3 alarm: ERROR is no statement of this control (a control writes ERROR = before a block that it could not read: write the block anew, formulas in one of their own)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 ERROR = L XQ102 + Q9

; == foo-no-statement-this-control
; 4:3 alarm: FOO is no statement of this control
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FOO 3

; == if-without-fn
; 4:1 alarm: IF is no statement of this control (a jump is FN 9: IF +Q1 EQU +Q3 GOTO LBL 5)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100 ; a tool
IF Q92 = Q78 GOTO LBL2

; == lx-no-statement-this-control
; 4:3 alarm: LX is no statement of this control (near: L)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 LX+5 Y

; == n-alone-begins-no-statement
; 4:1 alarm: N begins no statement (a straight line begins with L)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
N L X+5

; == nan-of-a-post
; 4:5 alarm: X needs a number, found 'n' (what wrote the program could not compute this number and wrote nan)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L Xnan Y+5

; == only-letters-axes-stand-here-example
; 4:15 alarm: only letters of axes stand here, for example X Y
TOOL CALL 1 Z S1000 F100
CYCL DEF 8.0 M
CYCL DEF 8.1 X+5

; == t-tolerance-stands-here
; 4:15 alarm: T, the tolerance, stands here
TOOL CALL 1 Z S200 F100
CYCL DEF 32.0 T
CYCL DEF 32.1 X1

; == tch-no-statement-this-control
; 4:3 alarm: TCH is no statement of this control (near: TCH PROBE)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TCH POBE 417

; == text-quotes-or-qs-parameter-was
; 4:9 alarm: a text in quotes or a QS parameter was expected, found '5'
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 QS1 = 5

; == toolcall-no-statement
; 4:3 alarm: TOOLCALL is no statement of this control (near: TOOL CALL)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 TOOLCALL 1 Z S1000

; == unit-program-missing-mm-or-inch-2
; 2:13 alarm: the unit of the program is missing: MM or INCH must follow its name
0 BEGIN PGM A

; == unit-program-missing-mm-or-inch
; 2:13 alarm: the unit of the program is missing: MM or INCH must follow its name
0 BEGIN PGM A
1 TOOL CALL 1 Z S1000 F100
2 END PGM A

; == was-expected-between-two-texts
; 4:13 alarm: || was expected between two texts
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 QS1 = "A" "B"
