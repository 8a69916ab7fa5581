; == 3-needs-address-before-it
; 4:9 alarm: '3' needs an address before it (a blank inside a number splits it)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 3

; == 5-needs-address-before-it
; 5:8 alarm: '5' needs an address before it (a blank inside a number splits it)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 200 D
Q200=2 5

; == cyrillic-letter
; 4:5 alarm: 'Х' is a Cyrillic letter (write the Latin letter X)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L Х+5

; == g-no-meaning-here
; 4:3 alarm: G has no meaning here (G words belong to DIN/ISO programs; write L, C, CR or CYCL DEF)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 G1 X5

; == m-needs-number
; 4:5 alarm: M needs a number, found 'X'
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L M X+5

; == needs-address-before-it
; 4:5 alarm: '+' needs an address before it (the axis letter is missing)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L +250 R0 FMAX

; == no-meaning-here-2
; 4:9 alarm: '/' has no meaning here
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+1 /

; == no-meaning-here
; 4:9 alarm: '/' has no meaning here (a formula stands in a block of its own, for example Q10 = Q1 / 2)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X-Q1/2

; == number-only-one-decimal-point-2
; 5:9 alarm: a number has only one decimal point
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 200 D
Q200=1,2,3

; == number-only-one-decimal-point
; 4:10 alarm: a number has only one decimal point
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+1.2.3

; == number-smaller-than-1e-09
; 4:6 alarm: a number must be smaller than 1e+09
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+99999999999

; == o-no-meaning-here
; 4:7 alarm: 'O' has no meaning here (the letter O stands where the digit 0 was meant)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X1O

; == r5-no-meaning-this-block
; 4:11 alarm: R5 has no meaning in this block (FL does not take R)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FL AN+0 R5

; == x-needs-number-2
; 4:9 alarm: X needs a number
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 LBL 1 X

; == x-needs-number-found-2
; 4:5 alarm: X needs a number, found '+'
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X++5

; == x-needs-number-found-3
; 4:5 alarm: X needs a number, found '"'
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X"5"

; == x-needs-number-found-f
; 4:5 alarm: X needs a number, found 'F'
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X FMAX

; == x-needs-number-found
; 4:5 alarm: X needs a number, found '=' (no = between an address and its number)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X=5

; == x-needs-number
; 4:5 alarm: X needs a number
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X

; == x-written-twice-this-block-2
; 5:22 alarm: X is written twice in this block (keep one of them)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 BLK FORM 0.1 Z X+0 Y+0 Z-20
3 BLK FORM 0.2 X+100 X+100 Z+0

; == x-written-twice-this-block-3
; 6:16 alarm: X is written twice in this block (keep one of them)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CYCL DEF 7.0 S
3 CYCL DEF 7.1 X+5
4 CYCL DEF 7.2 X+6

; == x-written-twice-this-block-4
; 14:21 alarm: X is written twice in this block (keep one of them)
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
4 CYCL CALL POS X+1 X+2 Y+2 Z+2

; == x-written-twice-this-block
; 4:9 alarm: X is written twice in this block (keep one of them)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 L X+5 X+6

; == x1-no-meaning-this-block
; 14:17 alarm: X1 has no meaning in this block
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
4 CYCL CALL PAT X+1

; == x3-no-meaning-this-block
; 5:16 alarm: X3 has no meaning in this block (LP does not take X)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CC X+5 Y+5
3 LP PR+5 PA+0 X+3

; == x5-no-meaning-this-block-2
; 4:33 alarm: X5 has no meaning in this block
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FN 9: IF +1 EQU +1 GOTO LBL 1 X5
3 LBL 1

; == x5-no-meaning-this-block
; 4:8 alarm: X5 has no meaning in this block
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 STOP X+5

; == y-needs-number
; 4:25 alarm: Y needs a number
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 PATTERN DEF POS1 (X+5 Y Z+0)
99 END PGM A MM

; == y-written-twice-this-block
; 5:28 alarm: Y is written twice in this block (keep one of them)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 BLK FORM 0.1 Z X+0 Y+0 Z-20
3 BLK FORM 0.2 X+100 Y+100 Y+0

; == z-needs-number
; 5:1 alarm: Z needs a number
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 PATTERN DEF POS1 (X+5 Y+0 Z
)
99 END PGM A MM

; == z3-no-meaning-this-block
; 5:16 alarm: Z3 has no meaning in this block (LP does not take Z)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 CC X+5 Y+5
3 LP PR+5 PA+0 Z+3

; == z5-no-meaning-this-block-4
; 4:6 alarm: Z5 has no meaning in this block (FL does not take Z)
0 BEGIN PGM A MM
1 TOOL CALL 1 Z S1000 F100
2 FL Z+5
